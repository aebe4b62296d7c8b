#include "CountedBytes.h"

#include "pointfront/Disk/InputFile.h"

#include <utility>

namespace pointfront
{
namespace
{
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
    ++counts_->reads;
    counts_->ranges += count;
    for (std::size_t i = 0; i < count; ++i)
    {
      counts_->bytes += ranges[i].size;
    }
    return file_->read(ranges, count);
  }

private:
  std::unique_ptr<const InputFile> file_;
  std::shared_ptr<const CountedBytes> counts_;
  ReadCost cost_;
};
} // namespace

std::shared_ptr<CountedBytes> CountedBytes::add()
{
  auto opener = std::make_shared<CountedBytes>();
  ByteOpeners::ofProcess().add("counted", opener);
  return opener;
}

Result<std::shared_ptr<const ByteSource>> CountedBytes::open(
  const std::string& address, const FirstBytes&) const
{
  Result<std::unique_ptr<const InputFile>> file =
    InputFile::open(address.substr(std::string("counted://").size()));
  if (!file)
  {
    return file.error();
  }
  ++opened;
  return std::shared_ptr<const ByteSource>(
    std::make_shared<const CountedSource>(address, std::move(*file), shared_from_this()));
}

} // namespace pointfront
