// SPDX-License-Identifier: MIT
#include "touchstone/tools/table.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <ostream>

namespace touchstone {

std::vector<std::size_t> Table::Widths() const {
  std::vector<std::size_t> widths(rows_.empty() ? 0 : rows_.front().size(), 0);
  for (const auto& row : rows_) {
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], row[k].size());
  }
  return widths;
}

void Table::Print(std::ostream& out) const {
  const std::vector<std::size_t> widths = Widths();
  for (const auto& row : rows_) {
    for (std::size_t k = 0; k < row.size(); ++k) {
      const std::string padding(widths[k] - row[k].size(), ' ');
      out << (k == 0 ? row[k] + padding : "  " + padding + row[k]);
    }
    out << '\n';
  }
}

void Table::PrintMarkdown(std::ostream& out) const {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    for (const std::string& cell : rows_[i]) out << "| " << cell << ' ';
    out << "|\n";
    if (i != 0) continue;
    for (std::size_t k = 0; k < rows_[i].size(); ++k) out << "|---";
    out << "|\n";
  }
}

std::string Fixed(double value, int digits) {
  std::array<char, 64> text;
  std::snprintf(text.data(), text.size(), "%.*f", digits, value);
  return text.data();
}

}  // namespace touchstone
