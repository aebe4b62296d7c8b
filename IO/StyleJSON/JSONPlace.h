#pragma once

#include "pointfront/Base/Error.h"
#include "pointfront/Base/NearestName.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace pointfront
{

/// Thrown inside this library only, where it is the shortest way out of nested values.
struct JSONRefusal
{
  std::string what;
  const nlohmann::json* value = nullptr; ///< at fault
};

/// A value of a JSON text and where it stands, "classes.6.size": reads what is expected there and
/// refuses all else by that name.
class JSONPlace
{
public:
  JSONPlace(const nlohmann::json& value, std::string path)
    : value_(value)
    , path_(std::move(path))
  {
  }

  const nlohmann::json& value() const { return value_; }
  const std::string& path() const { return path_; }
  bool isString() const { return value_.is_string(); }
  bool isArray() const { return value_.is_array(); }
  bool isObject() const { return value_.is_object(); }
  bool has(const char* key) const { return value_.is_object() && value_.contains(key); }

  [[noreturn]] void refuse(const std::string& why) const
  {
    throw JSONRefusal{ (path_.empty() ? std::string("the file") : path_) + ": " + why, &value_ };
  }

  JSONPlace at(const std::string& key) const
  {
    return JSONPlace(value_.at(key), path_.empty() ? key : path_ + "." + key);
  }
  JSONPlace at(std::size_t index) const
  {
    return JSONPlace(value_.at(index), path_ + "[" + std::to_string(index) + "]");
  }

  /// The place of an object that must have it.
  JSONPlace required(const char* key) const
  {
    if (!has(key))
    {
      refuse(std::string("expected the key ") + key);
    }
    return at(key);
  }

  /// An object with these keys at most.
  void expectKeys(const std::vector<std::string>& keys) const
  {
    if (!value_.is_object())
    {
      refuse("expected an object, not " + shown());
    }
    for (const auto& [key, unused] : value_.items())
    {
      static_cast<void>(unused);
      if (std::find(keys.begin(), keys.end(), key) == keys.end())
      {
        std::string list;
        for (const std::string& known : keys)
        {
          list += (list.empty() ? "" : ", ") + known;
        }
        at(key).refuse("there is no such key; use " + list + didYouMean(key, keys));
      }
    }
  }

  std::string text(const char* expected) const
  {
    if (!value_.is_string())
    {
      refuse(std::string("expected ") + expected + ", not " + shown());
    }
    return value_.get<std::string>();
  }

  bool truth() const
  {
    if (!value_.is_boolean())
    {
      refuse("expected true or false, not " + shown());
    }
    return value_.get<bool>();
  }

  double number() const
  {
    if (!value_.is_number())
    {
      refuse("expected a number, not " + shown());
    }
    return value_.get<double>();
  }

  double number(double low, double high) const
  {
    const double result = number();
    if (!(result >= low && result <= high))
    {
      refuse("expected a number from " + brief(low) + " to " + brief(high) + ", not " + shown());
    }
    return result;
  }

  double positive() const
  {
    const double result = number();
    if (!(result > 0.0))
    {
      refuse("expected a number above 0, not " + shown());
    }
    return result;
  }

  /// The value's text, cut where it is long.
  std::string shown() const
  {
    constexpr std::size_t most = 40;
    const std::string all = value_.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    return all.size() > most ? all.substr(0, most) + "..." : all;
  }

private:
  static std::string brief(double number) { return nlohmann::json(number).dump(); }

  const nlohmann::json& value_;
  std::string path_;
};

} // namespace pointfront
