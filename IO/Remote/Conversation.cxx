#include "Conversation.h"

#include "AnswerHeaders.h"
#include "TransferLoop.h"

#include "pointfront/Disk/StopOfReads.h"

#include <algorithm>
#include <cctype>
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

bool isForNow(long status)
{
  return status == 408 || status == 425 || status == 429 || status == 500 || status == 502 ||
    status == 503 || status == 504;
}

bool isRedirection(long status)
{
  return status == 301 || status == 302 || status == 303 || status == 307 || status == 308;
}

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

Error Conversation::changed(std::optional<RemoteIdentity>& identity) const
{
  if (identity)
  {
    identity->replaced = true;
  }
  return failed(
    Error::Kind::Unreadable, "has changed on its server while it was open; open it again");
}

Error Conversation::withoutParts() const
{
  return failed(Error::Kind::Unreadable,
    "is larger than " + std::to_string(options_.wholeAtMost >> 20) +
      " MiB and its server gives no parts of files (ranges); download it, or serve it with "
      "a server that does");
}

Error Conversation::refused(long status) const
{
  const std::string answer = "the server answers " + std::to_string(status);
  if (status == 404 || status == 410)
  {
    return failed(Error::Kind::NotFound, "does not exist: " + answer + "; check the address");
  }
  if (status == 401 || status == 403)
  {
    return failed(Error::Kind::Unreadable,
      "may not be read: " + answer +
        "; give keys or a token, or a new address if it was signed and has expired");
  }
  return failed(Error::Kind::Unreadable,
    "cannot be read: " + answer + (isForNow(status) ? ", again and again; try later" : ""));
}

HttpQuestion Conversation::questionFor(
  const WantedBytes& wanted, const std::optional<RemoteIdentity>& identity) const
{
  HttpQuestion question;
  Address place = request_.address;
  {
    Redirection& known = redirection();
    const std::lock_guard<std::mutex> lock(known.mutex);
    place = known.elsewhere.value_or(place);
  }
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

/// The answer is of the file that is known, or of the one that is known from now on.
Result<void> Conversation::compare(
  const HttpAnswer& answer, std::uint64_t bytes, std::optional<RemoteIdentity>& identity) const
{
  const RemoteIdentity found{ answer.header("etag"), answer.header("last-modified"), bytes, false,
    unchangedFor(answer) };
  if (!identity)
  {
    identity = found;
    return {};
  }
  const bool same = identity->bytes == found.bytes &&
    (!identity->tag.empty() || !found.tag.empty() ? identity->tag == found.tag
                                                  : identity->changed == found.changed);
  return same ? Result<void>() : changed(identity);
}

Result<Conversation::Verdict> Conversation::takePart(
  HttpAnswer& answer, WantedBytes& wanted, std::optional<RemoteIdentity>& identity) const
{
  const std::string coding = answer.header("content-encoding");
  if (!coding.empty() && coding != "identity")
  {
    return failed(Error::Kind::Unreadable,
      "is served compressed ('" + coding.substr(0, 20) +
        "'), so that no place in it can be found; switch compression off for it on the server");
  }
  if (!answer.range || answer.range->empty)
  {
    return failed(Error::Kind::Unreadable,
      "cannot be read in parts: the server does not say which bytes it gives (Content-Range)");
  }
  const ContentRange& range = *answer.range;
  if (Result<void> same = compare(answer, range.total, identity); !same)
  {
    return same.error();
  }
  if (wanted.tail && wanted.bytes.empty())
  {
    wanted.size = std::min(wanted.size, range.total);
    wanted.offset = range.total - wanted.size;
  }
  else if (wanted.offset + wanted.size > range.total)
  {
    wanted.size = range.total > wanted.offset ? range.total - wanted.offset : 0;
  }
  const std::uint64_t first = wanted.offset + wanted.bytes.size();
  if (range.first != first || range.last >= wanted.offset + wanted.size)
  {
    return failed(Error::Kind::Unreadable,
      "is served wrongly: bytes " + std::to_string(first) + " to " +
        std::to_string(wanted.offset + wanted.size - 1) + " were asked for, the server gives " +
        std::to_string(range.first) + " to " + std::to_string(range.last));
  }
  const std::uint64_t promised = range.last - range.first + 1;
  if (answer.body.size() > promised)
  {
    return failed(Error::Kind::Unreadable, "is served wrongly: more bytes come than are promised");
  }
  const bool news = !answer.body.empty();
  if (wanted.bytes.empty())
  {
    wanted.bytes = std::move(answer.body);
  }
  else
  {
    wanted.bytes.insert(wanted.bytes.end(), answer.body.begin(), answer.body.end());
  }
  wanted.complete = wanted.bytes.size() == wanted.size;
  return news ? Verdict::Good : Verdict::Again;
}

/// The server knows no ranges.
Result<Conversation::Verdict> Conversation::takeWhole(
  HttpAnswer& answer, WantedBytes& wanted, std::optional<RemoteIdentity>& identity) const
{
  const std::string length = answer.header("content-length");
  if (!answer.header("content-encoding").empty())
  {
    return failed(
      Error::Kind::Unreadable, "is served compressed; switch compression off for it on the server");
  }
  if (!length.empty() && std::strtoull(length.c_str(), nullptr, 10) != answer.body.size())
  {
    return Verdict::Again; // it ended too early
  }
  if (Result<void> same = compare(answer, answer.body.size(), identity); !same)
  {
    return same.error();
  }
  wanted.bytes = std::move(answer.body);
  wanted.offset = 0;
  wanted.size = wanted.bytes.size();
  wanted.complete = wanted.whole = true;
  return Verdict::Good;
}

/// A server may give parts, and the whole file for a part that counts from the end: its size says
/// where that is.
Result<Conversation::Verdict> Conversation::countFromFront(
  const HttpAnswer& answer, WantedBytes& wanted, std::optional<RemoteIdentity>& identity) const
{
  const std::string length = answer.header("content-length");
  if (length.empty())
  {
    return withoutParts();
  }
  const std::uint64_t total = std::strtoull(length.c_str(), nullptr, 10);
  if (Result<void> same = compare(answer, total, identity); !same)
  {
    return same.error();
  }
  wanted.tail = false;
  wanted.size = std::min(wanted.size, total);
  wanted.offset = total - wanted.size;
  return Verdict::Redirected;
}

Result<Conversation::Verdict> Conversation::redirect(const HttpAnswer& answer) const
{
  Redirection& known = redirection();
  const std::lock_guard<std::mutex> lock(known.mutex);
  if (++known.inSequence > options_.redirects)
  {
    return failed(Error::Kind::Unreadable,
      "is redirected more than " + std::to_string(options_.redirects) +
        " times, perhaps in a circle");
  }
  const Result<Address> next =
    known.elsewhere.value_or(request_.address).redirected(answer.header("location"));
  if (!next || (next->scheme != "http" && next->scheme != "https"))
  {
    return failed(Error::Kind::Unreadable, "is redirected to what is no http or https address");
  }
  known.elsewhere = *next;
  return Verdict::Redirected;
}

Result<Conversation::Verdict> Conversation::judge(
  HttpAnswer& answer, WantedBytes& wanted, std::optional<RemoteIdentity>& identity) const
{
  using Outcome = HttpAnswer::Outcome;
  switch (answer.outcome)
  {
    case Outcome::TooMuch:
      if (answer.status == 200)
      {
        return wanted.tail && wanted.bytes.empty() ? countFromFront(answer, wanted, identity)
                                                   : withoutParts();
      }
      return failed(
        Error::Kind::Unreadable, "is served wrongly: more bytes come than were asked for");
    case Outcome::NoConnection:
      if (answer.final)
      {
        return failed(Error::Kind::Unreadable, "cannot be reached: " + answer.text);
      }
      return Verdict::Again;
    case Outcome::Cancelled: // who asks looks at the time
    case Outcome::Broken:
      // The bytes in front of the break are right.
      return answer.status == 206 ? takePart(answer, wanted, identity)
                                  : Result<Verdict>(Verdict::Again);
    case Outcome::Answered:
      return judgeStatus(answer, wanted, identity);
  }
  return Verdict::Again;
}

Result<Conversation::Verdict> Conversation::judgeStatus(
  HttpAnswer& answer, WantedBytes& wanted, std::optional<RemoteIdentity>& identity) const
{
  if (answer.status == 206)
  {
    return takePart(answer, wanted, identity);
  }
  const bool fromEnd = wanted.tail && wanted.bytes.empty();
  if (answer.status == 200 && (!identity || (fromEnd && !answer.body.empty())))
  {
    return takeWhole(answer, wanted, identity);
  }
  if (answer.status == 200 && fromEnd)
  {
    return countFromFront(answer, wanted, identity);
  }
  if (isRedirection(answer.status))
  {
    return redirect(answer);
  }
  if (answer.status == 416 && !identity && answer.range && answer.range->total == 0)
  {
    identity = RemoteIdentity{ answer.header("etag"), answer.header("last-modified"), 0 };
    wanted.size = 0;
    wanted.complete = true;
    return Verdict::Good;
  }
  if (answer.status == 412 || answer.status == 416 || (answer.status == 200 && identity))
  {
    return changed(identity);
  }
  if (isForNow(answer.status))
  {
    return Verdict::Again;
  }
  Redirection& known = redirection();
  const std::lock_guard<std::mutex> lock(known.mutex);
  if (known.elsewhere && known.inSequence == 0)
  {
    known.elsewhere.reset(); // an earlier redirection may have expired
    return Verdict::Again;
  }
  return refused(answer.status);
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
