#include "Conversation.h"

#include "AnswerHeaders.h"
#include "TransferLoop.h"

#include "pointfront/Disk/StopOfReads.h"

#include <algorithm>
#include <memory>
#include <random>
#include <thread>
#include <utility>

namespace pointfront
{
namespace
{
using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds longestPause{ 8000 };

/// Half of the pause to all of it, so that many readers do not come back together.
milliseconds jittered(milliseconds pause)
{
  static thread_local std::minstd_rand chance(std::random_device{}());
  std::uniform_real_distribution<double> share(0.5, 1.0);
  return milliseconds(static_cast<long>(share(chance) * static_cast<double>(pause.count())));
}

bool isStopped(const std::atomic<bool>& cancelled)
{
  return cancelled || StopOfReads::asked();
}

/// Waits, and looks again and again whether it is stopped.
void pauseFor(milliseconds pause, Clock::time_point deadline, const std::atomic<bool>& cancelled)
{
  constexpr milliseconds step{ 25 };
  const Clock::time_point end = std::min(deadline, Clock::now() + pause);
  while (!isStopped(cancelled) && Clock::now() < end)
  {
    const auto left = std::chrono::duration_cast<milliseconds>(end - Clock::now());
    std::this_thread::sleep_for(std::clamp(left, milliseconds(1), step));
  }
}

std::string rangeOf(const WantedBytes& wanted)
{
  if (wanted.tail && wanted.bytes.empty())
  {
    return "-" + std::to_string(wanted.size);
  }
  const std::uint64_t first = wanted.offset + wanted.bytes.size();
  return std::to_string(first) + "-" + std::to_string(wanted.offset + wanted.size - 1);
}
} // namespace

Error Conversation::failed(Error::Kind kind, const std::string& what) const
{
  return makeError(kind, "'" + name_ + "' " + what);
}

Conversation::Redirection& Conversation::redirection() const
{
  return redirection_.get([] { return std::make_unique<Redirection>(); });
}

Address Conversation::placeNow() const
{
  Redirection& known = redirection();
  const std::lock_guard<std::mutex> lock(known.mutex);
  return known.elsewhere.value_or(request_.address);
}

HttpQuestion Conversation::questionFor(
  const WantedBytes& wanted, const std::optional<RemoteIdentity>& identity) const
{
  HttpQuestion question;
  const Address place = placeNow();
  question.url = place.text();
  if (place.origin() == request_.address.origin())
  {
    question.headers = request_.headers;
    question.signature = request_.signature;
  }
  question.headers.push_back("Accept-Encoding: identity");
  if (identity && !identity->tag.empty() && identity->tag.compare(0, 2, "W/") != 0)
  {
    question.headers.push_back("If-Match: " + identity->tag);
  }
  question.range = rangeOf(wanted);
  question.expected = wanted.size - wanted.bytes.size();
  question.wholeAtMost = identity ? 0 : options_.wholeAtMost;
  question.refusePrivate = options_.refusePrivate;
  return question;
}

namespace
{
/// One answer had the whole file: the others lie in it.
void skipOthers(const std::vector<WantedBytes*>& missing, std::size_t whole)
{
  for (std::size_t i = 0; i < missing.size(); ++i)
  {
    if (i != whole)
    {
      missing[i]->size = 0;
      missing[i]->bytes.clear();
      missing[i]->complete = true;
    }
  }
}
} // namespace

/// Asks once for all that is missing.
Result<Conversation::Round> Conversation::ask(const std::vector<WantedBytes*>& missing,
  std::optional<RemoteIdentity>& identity, ReadPatience& patience,
  const std::atomic<bool>& cancelled) const
{
  TransferLoop& loop = TransferLoop::ofProcess();
  std::vector<HttpQuestion> questions;
  for (const WantedBytes* one : missing)
  {
    questions.push_back(questionFor(*one, identity));
  }
  std::vector<HttpAnswer> answers = loop.run(line(), questions, patience, cancelled);
  Round round;
  bool refused = false;
  for (std::size_t i = 0; i < answers.size(); ++i)
  {
    answers[i].asked = questions[i].url;
    const Result<Verdict> verdict = judge(answers[i], *missing[i], identity);
    if (!verdict)
    {
      return verdict.error();
    }
    round.news = round.news || *verdict == Verdict::Good;
    if (missing[i]->whole)
    {
      skipOthers(missing, i);
      round.again = false;
      break;
    }
    if (*verdict == Verdict::Again)
    {
      round.again = true;
      round.askedPause = std::max(round.askedPause, askedPause(answers[i]));
      round.reason = isForNow(answers[i].status)
        ? "the server answers " + std::to_string(answers[i].status)
        : answers[i].text.empty() ? round.reason
                                  : answers[i].text;
      refused = refused || answers[i].outcome != HttpAnswer::Outcome::Cancelled;
    }
  }
  if (refused)
  {
    loop.noteRefusal(line());
  }
  if (round.news)
  {
    Redirection& known = redirection();
    const std::lock_guard<std::mutex> lock(known.mutex);
    known.inSequence = 0;
  }
  return round;
}

Result<void> Conversation::fetch(std::vector<WantedBytes>& wanted,
  std::optional<RemoteIdentity>& identity, const std::atomic<bool>& cancelled) const
{
  ReadPatience patience(options_.timeLimit, Clock::now());
  milliseconds pause = options_.firstPause;
  std::string reason = "no answer";
  for (unsigned tries = 0;;)
  {
    std::vector<WantedBytes*> missing;
    for (WantedBytes& one : wanted)
    {
      if (!one.complete && one.size > 0)
      {
        missing.push_back(&one);
      }
    }
    if (missing.empty())
    {
      return {};
    }
    const Result<Round> round = ask(missing, identity, patience, cancelled);
    if (!round)
    {
      return round.error();
    }
    if (isStopped(cancelled))
    {
      return failed(Error::Kind::Cancelled, "is not wanted any more");
    }
    tries = round->news ? 0 : tries;
    const bool late = patience.over(Clock::now());
    reason = !round->reason.empty()  ? round->reason
      : late && patience.bytes() > 0 ? "less than 1 KiB a second comes"
                                     : reason;
    if (!round->again)
    {
      continue;
    }
    if (late || ++tries > options_.retries)
    {
      return failed(Error::Kind::Unreadable,
        "cannot be read at the moment: " + reason + "; check the network and try again");
    }
    TransferLoop::ofProcess().noteRetry();
    pauseFor(std::max(round->askedPause, jittered(pause)), patience.deadline(), cancelled);
    pause = std::min(2 * pause, longestPause);
  }
}

} // namespace pointfront
