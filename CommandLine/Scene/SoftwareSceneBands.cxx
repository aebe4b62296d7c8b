// Pictures that are drawn in bands of rows, within the memory that there is.
#include "SoftwareScene.h"

#include "CancelSignal.h"
#include "Frustum.h"
#include "PicturePixels.h"

#include "pointfront/Residency/LoadScheduler.h"
#include "pointfront/Threads/ThreadCrew.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace pointfront
{

namespace
{
using Clock = std::chrono::steady_clock;

/// How far a splat reaches beyond the rows that its centre lies in, where its size is no number of
/// pixels.
constexpr int splatReachRows = 64;
} // namespace

/// The nodes that bands have drawn, each node once: neighbours share many.
struct SoftwareScene::DrawnNodes
{
  std::vector<std::unordered_map<NodeIndex, std::uint32_t>> points; ///< by node, for each store

  void add(std::size_t store, const FrontDelta& delta)
  {
    for (const DrawItem& item : delta.draw)
    {
      std::uint32_t& most = points[store][item.node];
      most = std::max(most, item.pointCount);
    }
  }
  void countIn(FrameRecord& frame) const
  {
    frame.points = 0;
    frame.nodes = 0;
    for (const auto& store : points)
    {
      frame.nodes += static_cast<std::int64_t>(store.size());
      for (const auto& [node, count] : store)
      {
        frame.points += count;
      }
    }
  }
};

Result<FrameRecord> SoftwareScene::renderInBands(const std::string& path)
{
  const CancelSignal finishing(CancelSignal::Mode::Finish);
  const auto begin = Clock::now();
  Result<std::unique_ptr<PNGWriter>> png = pngOf(path, options_.size);
  if (!png)
  {
    return png.error();
  }
  stores_.front()->residency().scheduler().setBudgetBytes(memory_->pointBytesOfBands());
  ThreadCrew crew(memory_->bandThreads());
  SoftwareRasteriser rasteriser(&crew);
  rasteriser_->release();
  FrameRecord whole;
  whole.complete = true;
  whole.rasteriseMilliseconds = 0.0;
  DrawnNodes drawn;
  drawn.points.resize(stores_.size());
  reads_.since();
  for (int top = camera_.height; top > 0; top -= memory_->bandRows())
  {
    const int bottom = std::max(0, top - memory_->bandRows());
    const PixelRectangle rows{ 0, std::max(0, bottom - memory_->overlapRows()), camera_.width,
      std::min(camera_.height, top + memory_->overlapRows()) };
    const Result<FrameRecord> band = renderBand(rasteriser, rows, drawn);
    if (!band)
    {
      return band;
    }
    if (!band->complete && !CancelSignal::requested())
    {
      return makeError(Error::Kind::NoMemory,
        "there is no memory to load the points; close other programs, raise the limit, or ask for "
        "less (--memory, --size)");
    }
    whole.add(*band);
    Result<void> fine = appendRows(**png, target_, bottom - rows.bottom, top - rows.bottom);
    if (fine && CancelSignal::requested())
    {
      fine = makeError(Error::Kind::Cancelled, "stopped; nothing was written");
    }
    if (!fine)
    {
      return fine.error();
    }
  }
  if (Result<void> written = (*png)->finish(); !written)
  {
    return written.error();
  }
  drawn.countIn(whole);
  whole.milliseconds = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
  whole.threadReadBytes = reads_.since();
  return whole;
}

Result<FrameRecord> SoftwareScene::renderBand(
  SoftwareRasteriser& rasteriser, const PixelRectangle& rows, DrawnNodes& drawn)
{
  // Points outside the rows may reach into them.
  const int reach = static_cast<int>(std::ceil(reachRows()));
  const int bottom = std::max(0, rows.bottom - reach);
  const int top = std::min(camera_.height, rows.top + reach);
  updateFronts(viewOfRows(camera_, bottom, top), true);
  FrameRecord frame = record(true);
  drawPart(rasteriser, rows, frame);
  rasteriser.release(); // it holds what it has drawn, and the next band needs the memory
  for (std::size_t i = 0; i < stores_.size(); ++i)
  {
    drawn.add(i, stores_[i]->last());
  }
  if (const Result<void> fine = outcome(); !fine)
  {
    return fine.error();
  }
  return frame;
}

double SoftwareScene::reachRows() const
{
  double reach = 0.0;
  forEachStyle(
    [&reach](const ResolvedStyle& style)
    {
      const bool pixels = style.size.mode == SplatSize::Mode::Pixels;
      reach = std::max<double>(reach, pixels ? 0.5 * style.size.value + 1.0 : splatReachRows);
    });
  return reach;
}

} // namespace pointfront
