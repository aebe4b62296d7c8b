#include "TransferLoop.h"

#include "Transfer.h"

#include "pointfront/Disk/ByteTraffic.h"
#include "pointfront/Disk/StopOfReads.h"
#include "pointfront/Threads/ForkHold.h"
#include "pointfront/Threads/OfProcess.h"
#include "pointfront/Threads/WorkerThread.h"

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <numeric>
#include <utility>

namespace pointfront
{
namespace
{
using Clock = std::chrono::steady_clock;

constexpr unsigned firstAtOnce = 8;
constexpr unsigned mostAtOnce = 32;
constexpr double usualRoundTrip = 0.05;

OfProcess<TransferLoop>& loops()
{
  const ForkHold hold;
  static auto* const all = new OfProcess<TransferLoop>; // never deleted: statics may read
  return *all;
}

CURLM* newMulti()
{
  const ForkHold hold; // the library sets itself up, and OpenSSL
  static const CURLcode ready = curl_global_init(CURL_GLOBAL_DEFAULT);
  return ready == CURLE_OK ? curl_multi_init() : nullptr;
}

using Transfers = std::vector<std::unique_ptr<Transfer>>;

bool allOver(const Transfers& transfers)
{
  return std::all_of(transfers.begin(), transfers.end(), [](const auto& t) { return t->over; });
}

bool anyBegun(const Transfers& transfers)
{
  return std::any_of(transfers.begin(), transfers.end(), [](const auto& t) { return t->begun; });
}

std::uint64_t receivedBy(const Transfers& transfers)
{
  return std::accumulate(transfers.begin(), transfers.end(), std::uint64_t(0),
    [](std::uint64_t sum, const auto& transfer) { return sum + transfer->received; });
}
} // namespace

struct TransferLoop::Content
{
  struct Line
  {
    std::deque<Transfer*> waiting;
    unsigned active = 0;
    unsigned atOnce = firstAtOnce;
    unsigned successes = 0; ///< since atOnce changed
    double roundTrip = 0.0; ///< 0: not known
    double bytesPerSecond = 0.0;
    // The time during which transfers were active lately:
    Clock::time_point busySince;
    std::uint64_t busyBytes = 0;
    std::uint64_t received = 0; ///< by transfers that are over
    Clock::time_point answered; ///< when it had answered last
  };

  CURLM* multi = nullptr;
  mutable std::mutex mutex; ///< guards all below
  std::condition_variable answered;
  std::map<std::string, Line> lines;
  std::vector<Transfer*> active;
  std::vector<Transfer*> withdrawn; ///< active ones that nobody waits for any more
  RemoteStatistics counts;
  bool stopped = false;
  bool running = false;
  WorkerThread thread;

  void work();
  void begin(std::unique_lock<std::mutex>& lock);
  void end(Transfer& transfer, CURLcode code);
  void remove(Transfer& transfer);
  void withdraw(const std::string& line, const Transfers& transfers);
  void measure(Line& line, const HttpAnswer& answer);
  std::uint64_t receivedOn(const std::string& line) const;
  bool ensureThread();
};

TransferLoop& TransferLoop::ofProcess()
{
  return loops().get([] { return std::make_unique<TransferLoop>(); });
}

TransferLoop::TransferLoop()
  : content_(std::make_unique<Content>())
{
  content_->multi = newMulti();
}

TransferLoop::~TransferLoop()
{
  {
    const std::lock_guard<std::mutex> lock(content_->mutex);
    content_->stopped = true;
  }
  if (content_->multi != nullptr)
  {
    curl_multi_wakeup(content_->multi);
    content_->thread.join();
    curl_multi_cleanup(content_->multi);
  }
}

bool TransferLoop::Content::ensureThread()
{
  if (!running && multi != nullptr)
  {
    running = thread.start([this] { work(); });
  }
  return running;
}

/// Starts what waits, as far as its line bears.
void TransferLoop::Content::begin(std::unique_lock<std::mutex>&)
{
  for (auto& [name, line] : lines)
  {
    while (!line.waiting.empty() && line.active < line.atOnce)
    {
      Transfer* const transfer = line.waiting.front();
      line.waiting.pop_front();
      if (line.active++ == 0)
      {
        line.busySince = Clock::now();
        line.busyBytes = 0;
      }
      active.push_back(transfer);
      transfer->begun = true;
      ++counts.requests;
      ByteTraffic::ofProcess().requests += 1;
      curl_multi_add_handle(multi, transfer->easy());
    }
  }
}

void TransferLoop::Content::measure(Line& line, const HttpAnswer& answer)
{
  constexpr double share = 0.3; // share of the newest value
  const bool right = answer.outcome == HttpAnswer::Outcome::Answered && answer.status < 300;
  if (!right)
  {
    return;
  }
  line.roundTrip = line.roundTrip == 0.0
    ? answer.firstByteSeconds
    : (1.0 - share) * line.roundTrip + share * answer.firstByteSeconds;
  line.busyBytes += answer.body.size();
  const double busy = std::chrono::duration<double>(Clock::now() - line.busySince).count();
  const double transferring = busy - line.roundTrip;
  if (line.busyBytes > (1u << 18) && transferring > 0.01)
  {
    const double rate = static_cast<double>(line.busyBytes) / transferring;
    line.bytesPerSecond =
      line.bytesPerSecond == 0.0 ? rate : (1.0 - share) * line.bytesPerSecond + share * rate;
  }
  if (++line.successes >= 2 * line.atOnce && line.atOnce < mostAtOnce)
  {
    ++line.atOnce;
    line.successes = 0;
  }
}

/// Takes an active transfer out.
void TransferLoop::Content::remove(Transfer& transfer)
{
  curl_multi_remove_handle(multi, transfer.easy());
  active.erase(std::find(active.begin(), active.end(), &transfer));
  Line& line = lines[transfer.line()];
  --line.active;
  line.received += transfer.received;
  if (transfer.answer().status != 0)
  {
    line.answered = Clock::now();
  }
  counts.bytes += transfer.answer().body.size();
  ByteTraffic::ofProcess().bytes += transfer.answer().body.size();
  transfer.over = true;
}

void TransferLoop::Content::end(Transfer& transfer, CURLcode code)
{
  transfer.conclude(code);
  measure(lines[transfer.line()], transfer.answer());
  remove(transfer);
}

void TransferLoop::Content::work()
{
  std::unique_lock<std::mutex> lock(mutex);
  while (!stopped)
  {
    for (Transfer* const transfer : std::exchange(withdrawn, {}))
    {
      if (!transfer->over)
      {
        transfer->giveUp();
        remove(*transfer);
      }
    }
    begin(lock);
    answered.notify_all();
    lock.unlock();
    // The callbacks touch their own transfers alone: no lock.
    int left = 0;
    curl_multi_perform(multi, &left);
    std::vector<std::pair<Transfer*, CURLcode>> ended;
    int more = 0;
    while (const CURLMsg* const message = curl_multi_info_read(multi, &more))
    {
      if (message->msg == CURLMSG_DONE)
      {
        char* transfer = nullptr;
        curl_easy_getinfo(message->easy_handle, CURLINFO_PRIVATE, &transfer);
        ended.emplace_back(reinterpret_cast<Transfer*>(transfer), message->data.result);
      }
    }
    if (ended.empty())
    {
      curl_multi_poll(multi, nullptr, 0, 1000, nullptr);
    }
    lock.lock();
    for (const auto& [transfer, code] : ended)
    {
      end(*transfer, code);
    }
  }
  for (Transfer* const transfer : std::vector<Transfer*>(active))
  {
    remove(*transfer);
  }
  answered.notify_all();
}

/// Withdraws a transfer that has not come: the loop must not know it when its question returns.
void TransferLoop::Content::withdraw(const std::string& line, const Transfers& transfers)
{
  std::deque<Transfer*>& waiting = lines[line].waiting;
  for (const auto& transfer : transfers)
  {
    const auto found = std::find(waiting.begin(), waiting.end(), transfer.get());
    if (found != waiting.end())
    {
      waiting.erase(found);
      transfer->over = true;
    }
    else if (!transfer->over)
    {
      withdrawn.push_back(transfer.get());
    }
  }
  curl_multi_wakeup(multi);
}

std::uint64_t TransferLoop::Content::receivedOn(const std::string& line) const
{
  std::uint64_t sum = lines.at(line).received;
  for (const Transfer* const transfer : active)
  {
    sum += transfer->line() == line ? transfer->received.load() : 0;
  }
  return sum;
}

std::vector<HttpAnswer> TransferLoop::run(const std::string& line,
  const std::vector<HttpQuestion>& questions, ReadPatience& patience,
  const std::atomic<bool>& cancelled)
{
  constexpr std::chrono::milliseconds lookAgain{ 25 }; // whether it is stopped
  Content& c = *content_;
  std::vector<HttpAnswer> answers(questions.size());
  Transfers transfers;
  for (std::size_t i = 0; i < questions.size(); ++i)
  {
    transfers.push_back(std::make_unique<Transfer>(line, questions[i], answers[i]));
  }
  bool stop = cancelled || StopOfReads::asked();
  std::unique_lock<std::mutex> lock(c.mutex);
  if (c.stopped || !c.ensureThread())
  {
    for (HttpAnswer& answer : answers)
    {
      answer.outcome = HttpAnswer::Outcome::NoConnection;
      answer.final = true;
      answer.text = "this process has no thread for the network";
    }
    return answers;
  }
  for (const auto& transfer : transfers)
  {
    c.lines[line].waiting.push_back(transfer.get());
  }
  curl_multi_wakeup(c.multi);
  const std::uint64_t earlier = patience.bytes();
  bool begun = false;
  const Clock::time_point queued = Clock::now();
  ReadPatience queue(patience.limit(), queued);
  queue.restart(c.receivedOn(line), queued);
  while (
    !allOver(transfers) && !c.stopped && !stop && !(begun ? patience : queue).over(Clock::now()))
  {
    c.answered.wait_until(lock, Clock::now() + lookAgain);
    const Clock::time_point now = Clock::now();
    const std::uint64_t sum = earlier + receivedBy(transfers);
    if (!begun && anyBegun(transfers))
    {
      begun = true;
      patience.extend(now - queued);
    }
    patience.note(sum, now);
    queue.note(c.receivedOn(line), now);
    lock.unlock(); // who is asked may wait for locks, such as Python's
    stop = cancelled || StopOfReads::asked();
    lock.lock();
  }
  c.withdraw(line, transfers);
  c.answered.wait(lock, [&] { return allOver(transfers); });
  patience.note(earlier + receivedBy(transfers), Clock::now());
  return answers;
}

bool TransferLoop::answeredSince(const std::string& line, Clock::time_point when) const
{
  const std::lock_guard<std::mutex> lock(content_->mutex);
  const auto found = content_->lines.find(line);
  return found != content_->lines.end() && found->second.answered >= when;
}

ReadCost TransferLoop::cost(const std::string& line) const
{
  const std::lock_guard<std::mutex> lock(content_->mutex);
  const auto found = content_->lines.find(line);
  ReadCost cost;
  cost.roundTripSeconds = usualRoundTrip;
  cost.readsAtOnce = firstAtOnce;
  if (found != content_->lines.end())
  {
    const Content::Line& known = found->second;
    cost.roundTripSeconds = known.roundTrip > 0.0 ? known.roundTrip : usualRoundTrip;
    cost.bytesPerSecond = known.bytesPerSecond;
    cost.readsAtOnce = known.atOnce;
  }
  constexpr double usualRate = 12.5e6;
  const double rate = cost.bytesPerSecond > 0.0 ? cost.bytesPerSecond : usualRate;
  cost.bytesAtOnce =
    static_cast<std::size_t>(std::clamp(rate * cost.roundTripSeconds, 65536.0, 4194304.0));
  return cost;
}

void TransferLoop::noteRefusal(const std::string& line)
{
  const std::lock_guard<std::mutex> lock(content_->mutex);
  Content::Line& known = content_->lines[line];
  known.atOnce = std::max(1u, known.atOnce / 2);
  known.successes = 0;
}

void TransferLoop::noteRetry()
{
  const std::lock_guard<std::mutex> lock(content_->mutex);
  ++content_->counts.retries;
  ByteTraffic::ofProcess().retries += 1;
}

RemoteStatistics TransferLoop::statistics() const
{
  const std::lock_guard<std::mutex> lock(content_->mutex);
  return content_->counts;
}

} // namespace pointfront
