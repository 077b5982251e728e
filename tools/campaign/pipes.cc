// SPDX-License-Identifier: MIT
#include "touchstone/tools/campaign/pipes.h"

#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>

namespace touchstone {
namespace {

using Length = std::uint64_t;

bool WriteAll(int pipe, const char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t written = write(pipe, data, size);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    data += written;
    size -= static_cast<std::size_t>(written);
  }
  return true;
}

bool ReadAll(int pipe, char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t got = read(pipe, data, size);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    data += got;
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

}  // namespace

bool WriteMessage(int pipe, std::string_view text) {
  const Length length = text.size();
  return WriteAll(pipe, reinterpret_cast<const char*>(&length), sizeof(length)) &&
         WriteAll(pipe, text.data(), text.size());
}

bool ReadMessage(int pipe, std::string& text) {
  Length length = 0;
  if (!ReadAll(pipe, reinterpret_cast<char*>(&length), sizeof(length))) return false;
  text.resize(length);
  return ReadAll(pipe, text.data(), text.size());
}

bool ReadSome(int pipe, std::string& received) {
  std::array<char, 65536> piece;
  const ssize_t got = read(pipe, piece.data(), piece.size());
  if (got < 0 && errno == EINTR) return true;
  if (got <= 0) return false;
  received.append(piece.data(), static_cast<std::size_t>(got));
  return true;
}

std::optional<std::string> TakeMessage(std::string& received) {
  Length length = 0;
  if (received.size() < sizeof(length)) return std::nullopt;
  std::memcpy(&length, received.data(), sizeof(length));
  if (received.size() < sizeof(length) + length) return std::nullopt;
  std::string message = received.substr(sizeof(length), length);
  received.erase(0, sizeof(length) + length);
  return message;
}

}  // namespace touchstone
