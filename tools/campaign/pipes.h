// SPDX-License-Identifier: MIT
//
// Messages over pipes: eight bytes of length in the machine's order, then the text.
#ifndef TOUCHSTONE_TOOLS_CAMPAIGN_PIPES_H_
#define TOUCHSTONE_TOOLS_CAMPAIGN_PIPES_H_

#include <optional>
#include <string>
#include <string_view>

namespace touchstone {

// False when the other end is gone.
bool WriteMessage(int pipe, std::string_view text);
bool ReadMessage(int pipe, std::string& text);

// Appends what the pipe holds; false at its end. Blocks only while it holds nothing.
bool ReadSome(int pipe, std::string& received);
// The first whole message, taken out; nothing while it is incomplete.
std::optional<std::string> TakeMessage(std::string& received);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_CAMPAIGN_PIPES_H_
