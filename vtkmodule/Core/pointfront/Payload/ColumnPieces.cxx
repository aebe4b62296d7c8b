#include "pointfront/Payload/ColumnPieces.h"

#include "pointfront/Points/NormalAttribute.h"
#include "pointfront/Points/SplatRadius.h"

namespace pointfront
{

ColumnPieces chooseColumnPieces(const AttributeSchema& schema)
{
  AttributeSchema drawn;
  for (const char* const name : { "rgb", "classification", splatRadiusAttribute })
  {
    drawn.add({ name });
  }
  drawn.add(normalAttribute());
  if (!schema.find("rgb"))
  {
    drawn.add({ "intensity" }); // the grey that stands for colours; half as large as these
  }
  ColumnPieces pieces;
  pieces.reserve(schema.size());
  for (const Attribute& attribute : schema)
  {
    pieces.push_back(drawn.find(attribute.name) ? 0 : 1);
  }
  return pieces;
}

} // namespace pointfront
