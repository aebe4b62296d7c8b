#pragma once

namespace pointfront
{

/// The thresholds that a front may work with: a geometric row with 64 rungs to a factor of two,
/// rung 0 the target and one rung exactly the initial threshold (FRONT-7). A threshold on
/// a ladder, not on a continuum, makes the settled one (the lowest rung that fits the budget) the
/// same whatever came before: two runs that reach rest give the same lists.
/// Units    pixels of projected point spacing.
/// Threads  a value.
class ThresholdLadder
{
public:
  ThresholdLadder() = default;
  /// Both > 0; an initial threshold below the target counts as the target.
  ThresholdLadder(double targetPx, double initialPx);

  double at(int rung) const;
  /// The lowest rung at or above `px`; 0 for anything below the target. At most highest().
  int rungFor(double px) const;
  int initialRung() const { return initialRung_; }
  /// Beyond the projection of anything (1e31 px).
  int highest() const;

private:
  double target_ = 1.0;
  double initial_ = 1.0;
  double octavesPerRung_ = 1.0 / 64.0;
  int initialRung_ = 0;
};

} // namespace pointfront
