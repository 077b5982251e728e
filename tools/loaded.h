// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_LOADED_H_
#define TOUCHSTONE_TOOLS_LOADED_H_

#include <optional>
#include <string>
#include <utility>

namespace touchstone {

// What a file held, or one line that says what is wrong with it and where.
template <class T>
class Loaded {
 public:
  Loaded(T value) : value_(std::move(value)) {}
  static Loaded Error(std::string message) { return Loaded(std::nullopt, std::move(message)); }

  bool ok() const { return value_.has_value(); }
  const std::string& error() const { return error_; }
  const T& operator*() const { return *value_; }
  const T* operator->() const { return &*value_; }

 private:
  Loaded(std::nullopt_t, std::string error) : error_(std::move(error)) {}

  std::optional<T> value_;
  std::string error_;
};

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_LOADED_H_
