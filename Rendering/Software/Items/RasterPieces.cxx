#include "RasterPieces.h"

namespace pointfront
{
namespace
{

/// Points that a thread draws at a time: a node, or a part of a large one.
constexpr std::uint32_t pointsOfPiece = 1u << 14;

} // namespace

void addPieces(
  const RasterItem& item, std::uint32_t first, std::uint32_t last, std::vector<RasterPiece>& pieces)
{
  for (; first < last; first += std::min(pointsOfPiece, last - first))
  {
    pieces.push_back({ &item, first, first + std::min(pointsOfPiece, last - first) });
  }
}

std::vector<RasterPiece> piecesOf(const RasterItems& items)
{
  std::vector<RasterPiece> pieces;
  for (const RasterItem& item : items.items())
  {
    addPieces(item, item.item->first, item.item->last, pieces);
  }
  return pieces;
}

} // namespace pointfront
