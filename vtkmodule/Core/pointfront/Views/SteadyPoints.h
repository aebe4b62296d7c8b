#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace pointfront
{

/// The points of a view in motion that holds still for a while: the mouse rests with its button
/// down. The times of such frames differ by chance, on a GPU by half and more, and with them what
/// a frame may have. Were each answer taken for ever, the detail would flicker and no frame be the
/// last: what grows in the one asks for the next.
/// Rest     the first 48 frames of a view have what they may have: the cost of a point is being
///          learnt (FrameCostModel). The last of them has the median of 24, and so have all that
///          follow, but where eight in a row may have twice as many or half as many: that is no
///          chance, and they have the least of the change.
/// Threads  one.
class SteadyPoints
{
public:
  /// Points of the next frame, for which there is time for `affordable`. `still`: it shows the same
  /// view as the one before.
  std::uint64_t next(std::uint64_t affordable, bool still);

private:
  std::uint64_t follow(std::uint64_t affordable);

  static constexpr std::size_t learningFrames = 48;
  static constexpr std::size_t medianFrames = 24;
  static constexpr int changedFrames = 8;

  std::uint64_t points_ = 0;
  std::size_t frames_ = 0; ///< frames of the same view
  std::array<std::uint64_t, medianFrames> answers_{}; ///< answers for the last of them
  int more_ = 0; ///< frames in a row that may have twice as many
  int fewer_ = 0; ///< likewise, half as many
  std::uint64_t leastChanged_ = 0; ///< the answer among these that is nearest to points_
};

} // namespace pointfront
