// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_CAMPAIGN_STABILITY_H_
#define TOUCHSTONE_TOOLS_CAMPAIGN_STABILITY_H_

#include <iosfwd>
#include <string>

#include "touchstone/tools/campaign/report.h"

namespace touchstone {

// How stable every engine of a campaign is: findings by kind, wrong verdicts by suite, by travel
// from contact and by scale, relative errors of distance and depth by scale and aspect. Prints the
// tables (Markdown when asked) and writes them as FOLDER/report/*.csv, one row an engine and class,
// with the plot of plot.py where Python and matplotlib are there. Throws BadInput where a file
// cannot be written.
void ReportStability(const CampaignTotals& totals, const std::string& folder, bool markdown,
                     std::ostream& out);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_CAMPAIGN_STABILITY_H_
