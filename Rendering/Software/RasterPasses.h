#pragma once

#include "LastPicture.h"
#include "RasterBuffers.h"
#include "RasterItems.h"
#include "RasterKernels.h"
#include "RasterPieces.h"
#include "SoftwareTarget.h"

#include <cstdint>
#include <vector>

namespace pointfront
{
class ThreadCrew;

/// The passes from a plan's items to a picture: who is seen in each pixel, then weights and colours
/// where splats are blended, then what is shown of those who are seen.
/// Threads  one thread at a time; works with those of a crew.
class RasterPasses
{
public:
  /// Where a picture goes.
  struct Destination
  {
    SoftwareTarget& target;
    std::uint16_t store = 0;
    bool standIns = false; ///< as WinnerResolve::Source's
  };

  explicit RasterPasses(ThreadCrew& threads)
    : crew(threads)
  {
  }

  /// The state that the next picture can go on from.
  struct Lasting
  {
    RasterBuffer<RasterKey> keys; ///< without what is passing, if they differ from the drawn ones
    BlendedSums sums; ///< likewise
    bool sumsLast = false; ///< else there are none to go on from
    std::uint64_t blended = 0; ///< points that went through the second pass
  };
  /// All passes but the last; `sums`: those of the picture that this one goes on from.
  Lasting drawPoints(const RasterItems& items, const RasterWindow& now,
    const LastPicture::Pieces& pieces, BlendedSums sums);
  /// After resolve(), where the sums last.
  BlendedSums takeSums(Lasting& lasting);
  void resolve(const RasterItems& items, const RasterWindow& now, const Destination& destination);

  ThreadCrew& crew;
  const RasterKernels* loops = &rasterKernels();
  std::vector<ThreadBuffers> buffers; ///< one a thread; the first has all keys after resolve()

private:
  void drawKeys(const RasterItems& items, const RasterWindow& now,
    const std::vector<RasterPiece>& pieces, bool goingOn);
  template <typename Then>
  void mergeKeys(const RasterWindow& now, const Then& then);
  void mergeKeys(const RasterWindow& now, float* depths);
  RasterBuffer<RasterKey> copyOfKeys(const RasterWindow& now);
  void addColours(const RasterItems& items, const RasterWindow& now,
    const LastPicture::Pieces& pieces, BlendedSums last, Lasting& lasting);
  void addPiecesTo(const RasterItems& items, const RasterWindow& now, const float* depths,
    const std::vector<RasterPiece>& pieces, Lasting& lasting);
  bool goOnWithSums(const RasterItems& items, const RasterWindow& now, const float* depths,
    const LastPicture::Pieces& pieces, BlendedSums& last);
  void mergeSums(const RasterWindow& now);

  RasterBuffer<float> nearest;
};

} // namespace pointfront
