#include "CountedBytes.h"

#include "pointfront/Disk/HeldBytes.h"
#include "pointfront/Disk/InputFile.h"

#include <algorithm>
#include <thread>
#include <utility>
#include <vector>

namespace pointfront
{
namespace
{
/// Without first bytes: those are a HeldBytes around it.
class CountedSource final : public ByteSource
{
public:
  CountedSource(std::string address, std::unique_ptr<const InputFile> file,
    std::shared_ptr<const CountedBytes> counts)
    : ByteSource(std::move(address), file->bytes())
    , file_(std::move(file))
    , counts_(std::move(counts))
    , cost_(counts_->cost)
  {
  }
  std::uint64_t device() const override { return ~file_->device(); }
  ReadCost cost() const override { return cost_; }
  Result<void> read(const ByteRange* ranges, std::size_t count) const override
  {
    return readUntil(ReadStop{ false }, ranges, count);
  }
  Result<void> readUntil(
    const ReadStop& stop, const ByteRange* ranges, std::size_t count) const override
  {
    if (!opening_)
    {
      ++counts_->reads;
      counts_->ranges += count;
    }
    for (std::size_t i = 0; i < count; ++i)
    {
      while (counts_->hangAt - ranges[i].offset < ranges[i].size && !stop)
      {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    }
    if (stop)
    {
      return makeError(Error::Kind::Cancelled, "stopped");
    }
    const std::uint64_t atOnce = ++under_;
    std::uint64_t most = counts_->readsAtOnceMost;
    while (atOnce > most && !counts_->readsAtOnceMost.compare_exchange_weak(most, atOnce))
    {
    }
    counts_->transfer(request(ranges, count));
    --under_;
    return file_->read(ranges, count);
  }
  void opened() { opening_ = false; }

private:
  /// Counts the requests for these ranges; their bytes, with the gaps that they load.
  std::size_t request(const ByteRange* ranges, std::size_t count) const
  {
    std::vector<ByteRange> sorted(ranges, ranges + count);
    std::sort(sorted.begin(), sorted.end(),
      [](const ByteRange& a, const ByteRange& b) { return a.offset < b.offset; });
    std::uint64_t number = 0;
    std::uint64_t bytes = 0;
    std::uint64_t end = 0;
    for (const ByteRange& range : sorted)
    {
      const bool begins = number == 0 || range.offset > end + counts_->mergeGapBytes;
      number += begins ? 1 : 0;
      const std::uint64_t from = begins ? range.offset : end;
      end = std::max(from, range.offset + range.size);
      bytes += end - from;
    }
    counts_->requests += opening_ ? 0 : number;
    return static_cast<std::size_t>(bytes);
  }

  std::unique_ptr<const InputFile> file_;
  std::shared_ptr<const CountedBytes> counts_;
  ReadCost cost_;
  bool opening_ = true;
  mutable std::atomic<std::uint64_t> under_{ 0 };
};
} // namespace

std::shared_ptr<CountedBytes> CountedBytes::add()
{
  auto opener = std::make_shared<CountedBytes>();
  ByteOpeners::ofProcess().add("counted", opener);
  return opener;
}

void CountedBytes::transfer(std::size_t size) const
{
  bytes += size;
  if (roundTrip.count() == 0.0 && bytesPerSecond == 0.0)
  {
    return;
  }
  Clock::time_point end = Clock::now() + std::chrono::duration_cast<Clock::duration>(roundTrip);
  if (bytesPerSecond > 0.0)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const std::chrono::duration<double> seconds(static_cast<double>(size) / bytesPerSecond);
    end = std::max(end, lineFree_) + std::chrono::duration_cast<Clock::duration>(seconds);
    lineFree_ = end;
  }
  std::this_thread::sleep_until(end);
}

Result<std::shared_ptr<const ByteSource>> CountedBytes::open(
  const std::string& address, const FirstBytes& first) const
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (std::shared_ptr<const ByteSource> same = open_[address].lock())
    {
      return same;
    }
  }
  Result<std::unique_ptr<const InputFile>> file =
    InputFile::open(address.substr(std::string("counted://").size()));
  if (!file)
  {
    return file.error();
  }
  ++opened;
  ++requests;
  const std::uint64_t size = (*file)->bytes();
  const std::uint64_t most = firstBytes ? size : 0;
  const auto head = static_cast<std::size_t>(std::min<std::uint64_t>(first.head, most));
  const auto tail =
    static_cast<std::size_t>(firstBytes ? std::min<std::uint64_t>(first.tail, size - head) : 0);
  const auto source =
    std::make_shared<CountedSource>(address, std::move(*file), shared_from_this());
  Result<std::shared_ptr<const ByteSource>> held =
    HeldBytes::hold(source, { { 0, head }, { size - tail, tail } });
  source->opened();
  if (held)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    open_[address] = *held;
  }
  return held;
}

} // namespace pointfront
