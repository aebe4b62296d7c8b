#include "pointfront/Build/StoredColours.h"

#include <algorithm>

namespace pointfront
{

bool hasNarrowColours(const std::vector<std::unique_ptr<PointSource>>& sources,
  const IngestedPoints& points, std::size_t source)
{
  return points.largestColour[source] > 0 && points.largestColour[source] <= 255 &&
    !sources[source]->description().deepColours;
}

Result<StoredColours> storedColours(const std::vector<std::unique_ptr<PointSource>>& sources,
  const CommonSchema& common, const RecordColumns& columns, const IngestedPoints& points,
  ColourDepth depth, bool wideElsewhere)
{
  const auto& largest = points.largestColour;
  for (std::size_t s = 0; s < sources.size(); ++s)
  {
    if (depth == ColourDepth::Eight && largest[s] > 255)
    {
      const SourceDescription& source = sources[s]->description();
      return makeError(Error::Kind::BadArgument,
        "'" + (source.colourImage.empty() ? source.path : source.colourImage) +
          "' has a colour of " + std::to_string(largest[s]) +
          ", which is more than 8 bits hold; let the colour depth be 16, or found by file");
    }
  }
  StoredColours stored;
  const auto column = wideColourColumn(common.schema);
  bool wide = depth == ColourDepth::Sixteen || (depth == ColourDepth::ByFile && wideElsewhere);
  for (std::size_t s = 0; s < sources.size(); ++s)
  {
    wide = wide || largest[s] > 255 ||
      (depth == ColourDepth::ByFile && sources[s]->description().deepColours && largest[s] > 0);
  }
  if (!column || wide)
  {
    stored.schema = common.schema;
  }
  else
  {
    for (std::size_t c = 0; c < common.schema.size(); ++c)
    {
      Attribute attribute = common.schema[c];
      attribute.type = c == *column ? ScalarType::UInt8 : attribute.type;
      stored.schema.add(std::move(attribute));
    }
  }
  if (!column || !wide || depth == ColourDepth::Sixteen)
  {
    return stored;
  }
  stored.widening.emplace();
  stored.widening->offset = RecordLayout(columns.schema()).offset(*columns.place(*column));
  stored.widening->components = common.schema[*column].components;
  std::uint64_t begin = 0;
  for (std::size_t s = 0; s < sources.size(); ++s)
  {
    if (hasNarrowColours(sources, points, s))
    {
      stored.widening->runs.push_back({ begin, points.sourceEnd[s] - begin });
    }
    begin = points.sourceEnd[s];
  }
  return stored;
}

} // namespace pointfront
