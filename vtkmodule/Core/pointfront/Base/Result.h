#pragma once

#include "pointfront/Base/Error.h"

#include <cassert>
#include <optional>
#include <utility>
#include <variant>

namespace pointfront
{

/// A value, or the Error that explains why there is none.
/// Like std::expected of C++23, reduced to what the kernel uses. [[nodiscard]]: an Error is
/// handled or handed on, never dropped.
template <typename T>
class [[nodiscard]] Result
{
public:
  Result(T value) // NOLINT(google-explicit-constructor): `return value;` is the point
    : content_(std::in_place_index<0>, std::move(value))
  {
  }
  Result(Error error) // NOLINT(google-explicit-constructor)
    : content_(std::in_place_index<1>, std::move(error))
  {
  }

  bool ok() const { return content_.index() == 0; }
  explicit operator bool() const { return ok(); }

  T& value() &
  {
    assert(ok());
    return std::get<0>(content_);
  }
  const T& value() const&
  {
    assert(ok());
    return std::get<0>(content_);
  }
  T&& value() &&
  {
    assert(ok());
    return std::get<0>(std::move(content_));
  }
  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }

  const Error& error() const
  {
    assert(!ok());
    return std::get<1>(content_);
  }

private:
  std::variant<T, Error> content_;
};

/// Success, or the Error that explains the failure.
template <>
class [[nodiscard]] Result<void>
{
public:
  Result() = default;
  Result(Error error) // NOLINT(google-explicit-constructor)
    : error_(std::move(error))
  {
  }

  bool ok() const { return !error_.has_value(); }
  explicit operator bool() const { return ok(); }
  const Error& error() const
  {
    assert(!ok());
    return *error_;
  }

private:
  std::optional<Error> error_;
};

} // namespace pointfront
