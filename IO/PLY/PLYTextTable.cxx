#include "PLYTextTable.h"

#include <utility>

namespace pointfront
{

Result<void> PLYTextTable::index(const SurveyOptions& survey)
{
  const char* text = reinterpret_cast<const char*>(file_.map.data());
  const std::size_t size = file_.map.size();
  TextRegion region{ file_.header.bodyOffset, size, file_.header.lines + 1 };
  for (std::size_t e = 0; e < file_.points; ++e)
  {
    const PLYElement& element = file_.header.elements[e];
    const SkippedLines skipped = skipLines(text, region.begin, size, element.count);
    region.begin = skipped.end;
    region.firstLine += skipped.lines;
  }
  const std::uint64_t claimed = file_.pointElement().count;
  const SkippedLines points = skipLines(text, region.begin, size, claimed);
  region.end = points.end;
  if (points.found == 0 && claimed > 0)
  {
    return makeError(Error::Kind::Truncated,
      file_.path + ": the header promises " + std::to_string(claimed) + " points from line " +
        std::to_string(region.firstLine) + " on: there is none; get a whole copy");
  }
  if (points.found < claimed)
  {
    file_.warnings.push_back(std::to_string(claimed - points.found) + " of " +
      std::to_string(claimed) + " points are missing: the file ends after " +
      std::to_string(points.found) + " of them.");
  }
  TextLayout layout;
  layout.comments = false;
  for (const PLYProperty& property : file_.pointElement().properties)
  {
    TextLayout::Cell cell;
    cell.list = property.listCount.has_value();
    if (!cell.list)
    {
      cell.field = layout.fieldCount++;
    }
    layout.cells.push_back(cell);
  }
  if (Result<void> opened = openRows(file_.map, region, std::move(layout), survey); !opened)
  {
    return opened;
  }
  complain(file_.warnings);
  widenTypes(statistics(), fields_, file_.warnings);
  return {};
}

Result<std::unique_ptr<PointTable>> PLYTextTable::open(PLYFile file, const SurveyOptions& survey)
{
  // The rows keep the map's address: the table must not move once they are there.
  auto table = std::unique_ptr<PLYTextTable>(new PLYTextTable(std::move(file)));
  if (Result<void> done = table->index(survey); !done)
  {
    return done.error();
  }
  return std::unique_ptr<PointTable>(std::move(table));
}

} // namespace pointfront
