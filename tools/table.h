// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_TABLE_H_
#define TOUCHSTONE_TOOLS_TABLE_H_

#include <iosfwd>
#include <string>
#include <vector>

namespace touchstone {

// A table whose columns are as wide as what they hold; the first is flushed left.
class Table {
 public:
  void Row(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }

  // Every row has as many cells as the first.
  void Print(std::ostream& out) const;
  // The same as a table of Markdown, the first row its head.
  void PrintMarkdown(std::ostream& out) const;

 private:
  std::vector<std::size_t> Widths() const;

  std::vector<std::vector<std::string>> rows_;
};

// With so many digits after the point.
std::string Fixed(double value, int digits);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_TABLE_H_
