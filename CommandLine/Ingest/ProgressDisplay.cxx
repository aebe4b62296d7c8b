#include "ProgressDisplay.h"

#include "CancelSignal.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <unistd.h>

namespace pointfront
{

namespace
{
/// The first moments say nothing about the rest.
constexpr double leastFractionForEstimate = 0.02;

std::optional<double> secondsRemaining(const Progress& progress)
{
  if (progress.fraction < leastFractionForEstimate || progress.secondsElapsed <= 0.0)
  {
    return std::nullopt;
  }
  return progress.secondsElapsed * (1.0 - progress.fraction) / progress.fraction;
}

std::string durationText(double seconds)
{
  const long whole = std::lround(std::ceil(seconds));
  char text[32];
  if (whole < 60)
  {
    std::snprintf(text, sizeof(text), "%ld s", whole);
  }
  else if (whole < 3600)
  {
    std::snprintf(text, sizeof(text), "%ld:%02ld min", whole / 60, whole % 60);
  }
  else
  {
    std::snprintf(text, sizeof(text), "%ld:%02ld h", whole / 3600, whole / 60 % 60);
  }
  return text;
}
} // namespace

std::optional<ProgressDisplay::Style> ProgressDisplay::styleOf(const std::string& name)
{
  if (name == "auto")
  {
    return isatty(STDERR_FILENO) ? Style::Line : Style::None;
  }
  if (name == "plain")
  {
    return Style::Plain;
  }
  if (name == "json")
  {
    return Style::Json;
  }
  if (name == "none")
  {
    return Style::None;
  }
  return std::nullopt;
}

ProgressDisplay::~ProgressDisplay()
{
  if (lineOpen_)
  {
    std::fputs("\r\033[K", stderr);
  }
}

ProgressFunction ProgressDisplay::function()
{
  return [this](const Progress& progress)
  {
    show(progress);
    return !CancelSignal::requested();
  };
}

std::string ProgressDisplay::text(const Progress& progress, double pointsPerSecond)
{
  char text[160];
  int length = std::snprintf(text, sizeof(text), "%5.1f %%  %-9s %8.2f M points",
    100.0 * progress.fraction, progress.phase, static_cast<double>(progress.done) * 1e-6);
  std::string line(text, static_cast<std::size_t>(length));
  if (progress.total > 0)
  {
    std::snprintf(text, sizeof(text), " of %.2f M", static_cast<double>(progress.total) * 1e-6);
    line += text;
  }
  if (pointsPerSecond > 0.0)
  {
    std::snprintf(text, sizeof(text), "  %.2f M/s", pointsPerSecond * 1e-6);
    line += text;
  }
  if (const std::optional<double> rest = secondsRemaining(progress))
  {
    line += "  " + durationText(*rest) + " left";
  }
  return line;
}

std::string ProgressDisplay::json(const Progress& progress, double pointsPerSecond)
{
  nlohmann::ordered_json object;
  object["phase"] = progress.phase;
  object["done"] = progress.done;
  object["total"] = progress.total;
  object["fraction"] = progress.fraction;
  object["points_per_second"] = std::llround(pointsPerSecond);
  object["seconds"] = progress.secondsElapsed;
  const std::optional<double> rest = secondsRemaining(progress);
  object["seconds_remaining"] = rest ? nlohmann::ordered_json(*rest) : nlohmann::ordered_json();
  if (!progress.notice.empty())
  {
    object["notice"] = progress.notice;
  }
  return object.dump();
}

void ProgressDisplay::show(const Progress& progress)
{
  if (style_ == Style::None)
  {
    return;
  }
  if (style_ != Style::Json && !progress.notice.empty())
  {
    std::fprintf(stderr, "%s%s\n", lineOpen_ ? "\r\033[K" : "", progress.notice.c_str());
    lineOpen_ = false;
    return;
  }
  const bool newPhase = phase_ != progress.phase;
  if (newPhase)
  {
    phase_ = progress.phase;
    phaseBegan_ = progress.secondsElapsed;
    phaseDone_ = progress.done;
  }
  const double plainInterval = 2.0;
  if (style_ == Style::Plain && !newPhase && progress.secondsElapsed - shownAt_ < plainInterval)
  {
    return;
  }
  shownAt_ = progress.secondsElapsed;
  const double seconds = progress.secondsElapsed - phaseBegan_;
  const double points = static_cast<double>(progress.done) - static_cast<double>(phaseDone_);
  const double rate = seconds > 0.0 && points > 0.0 ? points / seconds : 0.0;
  if (style_ == Style::Line)
  {
    std::fprintf(stderr, "\r%s\033[K", text(progress, rate).c_str());
    std::fflush(stderr);
    lineOpen_ = true;
  }
  else
  {
    const std::string line = style_ == Style::Json ? json(progress, rate) : text(progress, rate);
    std::fprintf(stderr, "%s\n", line.c_str());
  }
}

} // namespace pointfront
