#pragma once

#include "pointfront/Points/AttributeSchema.h"
#include "pointfront/Points/ScalarType.h"

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace pointfront
{

/// The role of a field in a point, by its name. Only this file knows the names that other programs
/// use.
/// Spelling   case, blanks, '_' and '-' do not matter; a leading "scalar_" (CloudCompare) is
///            dropped, and so is a unit behind a coordinate: "X (m)", "lat[deg]", "Easting_ft".
///            "Intensity", "scalar_Intensity" and "i" are the attribute "intensity";
///            "red", "R" and "diffuse_red" are component 0 of "rgb"; "nx", "normal_x" of "normal".
struct FieldRole
{
  enum class Kind
  {
    Position, ///< component 0, 1, 2: x, y, z
    Vector, ///< a component of `attribute`, which exists only if all three are there
    Attribute, ///< `attribute`
    Padding ///< "_" and "-": bytes without a meaning
  };
  Kind kind = Kind::Attribute;
  std::string attribute;
  unsigned component = 0;
  std::optional<ScalarType> type = {}; ///< the type of a well-known attribute
  /// How sure the name of a position is: 0 x, y, z; 1 easting, longitude, Points:0 ...; 2 names
  /// that also stand for other things: e, n, h, height.
  unsigned preference = 0;
};

FieldRole roleOf(std::string_view name);

/// The roles of fields that stand together. A coordinate is the field with the surest name; others
/// of that coordinate are attributes of their own names. e and n count only together.
std::vector<FieldRole> rolesOf(const std::vector<std::string>& names);

/// Names of the attributes of a schema as the fields of a file beside x, y and z, which roleOf()
/// tells apart: the attribute's own as `cleaned` has it, with "_2", "_3" ... behind it if it would
/// be read as a coordinate, as a component of `rgb` or `normal`, as another attribute, or not at
/// all. An attribute that is read by its own name keeps it, wherever it stands.
/// `rgb` and `normal`  of three components have names that the format gives: red, nx ...
class FieldNames
{
public:
  using Cleaned = std::string (*)(const std::string& attribute);
  FieldNames(const AttributeSchema& schema, Cleaned cleaned);

  /// The name of an attribute, or of all its components.
  const std::string& operator[](std::size_t column) const { return names_[column]; }
  /// Attributes with another name than their own: full sentences.
  const std::vector<std::string>& findings() const { return findings_; }

private:
  bool take(const std::string& name);

  std::vector<std::string> names_; ///< one for each attribute
  std::vector<std::string> findings_;
  std::set<std::string> vectors_; ///< attributes with names that the format gives
  std::set<std::string> taken_; ///< attributes as they will be read
};

} // namespace pointfront
