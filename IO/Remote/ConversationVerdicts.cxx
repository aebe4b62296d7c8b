// Judges answers: bytes of the file that is meant, a reason to ask again, or an error.
#include "Conversation.h"

#include "AnswerHeaders.h"
#include "HttpTransfer.h"

#include "pointfront/Disk/ByteOpeners.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace pointfront
{
namespace
{
bool isRedirection(long status)
{
  return status == 301 || status == 302 || status == 303 || status == 307 || status == 308;
}
} // namespace

bool Conversation::isForNow(long status)
{
  return status == 408 || status == 425 || status == 429 || status == 500 || status == 502 ||
    status == 503 || status == 504;
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

Error Conversation::refused(const HttpAnswer& answer) const
{
  const long status = answer.status;
  const std::string code = faultCode(answer);
  const std::string said =
    "the server answers " + std::to_string(status) + (code.empty() ? "" : " (" + code + ")");
  if (status == 404 || status == 410)
  {
    return failed(Error::Kind::NotFound, "does not exist: " + said + "; check the address");
  }
  if (code == "ExpiredToken" || code == "TokenRefreshRequired" || code == "InvalidToken")
  {
    return failed(Error::Kind::Unreadable,
      "may not be read: " + said +
        "; the keys have run out: get new ones, and AWS_SESSION_TOKEN with them");
  }
  if (code == "AuthorizationHeaderMalformed")
  {
    const std::string region = bucketRegion(answer);
    return failed(Error::Kind::Unreadable,
      "may not be read: " + said + "; " +
        (region.empty() ? "check AWS_ACCESS_KEY_ID, and set AWS_REGION to the bucket's region"
                        : "set AWS_REGION=" + region));
  }
  if (status == 401 || status == 403)
  {
    return failed(Error::Kind::Unreadable,
      "may not be read: " + said +
        "; give keys or a token, or a new address if it was signed and has expired");
  }
  return failed(Error::Kind::Unreadable,
    "cannot be read: " + said + (isForNow(status) ? ", again and again; try later" : ""));
}

/// A redirection that does not say where to. Amazon's does so for a bucket of another region.
Error Conversation::elsewhereUnknown(const HttpAnswer& answer) const
{
  const std::string said = "the server answers " + std::to_string(answer.status);
  const std::string region = bucketRegion(answer);
  const bool store = schemeOf(name_) == "s3";
  if (!store && region.empty())
  {
    return failed(Error::Kind::Unreadable,
      "cannot be read: " + said + ", a redirection, and does not say to where");
  }
  const std::string where =
    region.empty() ? "in another region, perhaps" : "in the region " + region;
  return failed(Error::Kind::Unreadable,
    "lies " + where + ": " + said + "; " +
      (store ? "set AWS_REGION=" + (region.empty() ? "REGION" : region)
             : "use the address of that region"));
}

/// The answer is of the file that is known, or of the one that is known from now on.
Result<void> Conversation::compare(
  const HttpAnswer& answer, std::uint64_t bytes, std::optional<RemoteIdentity>& identity) const
{
  RemoteIdentity found{ answer.header("etag"), answer.header("last-modified"), bytes, false,
    unchangedFor(answer) };
  if (!identity)
  {
    Redirection& known = redirection();
    const std::lock_guard<std::mutex> lock(known.mutex);
    found.unchangedFor = std::min(found.unchangedFor, known.lastsFor);
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
  const Address from = known.elsewhere.value_or(request_.address);
  if (answer.asked != from.text())
  {
    return Verdict::Redirected; // another answer of the same place was followed already
  }
  if (++known.inSequence > options_.redirects)
  {
    return failed(Error::Kind::Unreadable,
      "is redirected more than " + std::to_string(options_.redirects) +
        " times, perhaps in a circle");
  }
  const Result<Address> next = from.redirected(answer.header("location"));
  if (!next || (next->scheme != "http" && next->scheme != "https"))
  {
    return failed(Error::Kind::Unreadable, "is redirected to what is no http or https address");
  }
  known.elsewhere = *next;
  known.lastsFor = std::min(known.lastsFor, unchangedFor(answer));
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
    return answer.header("location").empty() ? elsewhereUnknown(answer) : redirect(answer);
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
  if (answer.asked != known.elsewhere.value_or(request_.address).text())
  {
    return Verdict::Again; // another answer said so before
  }
  if (known.elsewhere && known.inSequence == 0)
  {
    known.elsewhere.reset(); // an earlier redirection may have expired
    known.lastsFor = std::chrono::seconds::max();
    return Verdict::Again;
  }
  return refused(answer);
}

} // namespace pointfront
