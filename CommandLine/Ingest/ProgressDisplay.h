#pragma once

#include "pointfront/Base/Progress.h"

#include <optional>
#include <string>

namespace pointfront
{

/// Shows on stderr how a long operation gets on, and passes a SIGINT or SIGTERM on to it.
/// Styles   Line: one line that is rewritten, for a terminal. Plain: one line at a new phase and
///          every two seconds. Json: one object a report: phase, done, total, fraction,
///          points_per_second, seconds, seconds_remaining (null until there is an estimate);
///          notice, a sentence, when there is one. None.
/// Threads  as ProgressFunction: one at a time.
class ProgressDisplay
{
public:
  enum class Style
  {
    Line,
    Plain,
    Json,
    None
  };
  /// "plain", "json", "none", or "auto": Line if stderr is a terminal, None otherwise.
  static std::optional<Style> styleOf(const std::string& name);

  explicit ProgressDisplay(Style style)
    : style_(style)
  {
  }
  ~ProgressDisplay();
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  /// To hand to the operation; refers to this object.
  ProgressFunction function();

  /// The text that Line and Plain print for one report, without the line's end.
  static std::string text(const Progress& progress, double pointsPerSecond);
  /// The text that Json prints.
  static std::string json(const Progress& progress, double pointsPerSecond);

private:
  void show(const Progress& progress);

  Style style_;
  std::string phase_;
  double phaseBegan_ = 0.0; ///< seconds into the operation
  std::uint64_t phaseDone_ = 0; ///< points at that time
  double shownAt_ = -1.0e9; ///< seconds into the operation
  bool lineOpen_ = false; ///< Line: something to clear
};

} // namespace pointfront
