#pragma once

#include "pointfront/Base/Result.h"

#include <nlohmann/json.hpp>

#include <string>

namespace pointfront
{

/// A JSON text that a person wrote, and its values. It knows in which line a value stands, so that
/// messages about a value can say so.
class JSONText
{
public:
  enum class Keys
  {
    Any, ///< the last of two equal keys in one object counts
    Unique ///< two equal keys in one object are an Error
  };
  /// Errors  BadFormat: "not JSON: line 3, column 12: " and what the parser expected there.
  static Result<JSONText> parse(std::string text, Keys keys = Keys::Any);

  const nlohmann::json& value() const { return value_; }
  /// "line 4: ", where the key of that value stands, or the value itself if it has no key. Empty if
  /// the text has one line only, or if the value is none of this text.
  std::string lineOf(const nlohmann::json& value) const;

private:
  std::string text_;
  nlohmann::json value_;
};

} // namespace pointfront
