#include "FilesInTheMaking.h"
#include "SampleStore.h"

#include "pointfront/Disk/OutputFile.h"
#include "pointfront/Store/StoreAssembly.h"

#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <limits>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace pointfront
{
namespace
{
namespace fs = std::filesystem;

/// A disk that takes so many bytes and no more.
class SmallDisk final : public OutputFile
{
public:
  SmallDisk(std::uint64_t capacity, bool& published)
    : capacity_(capacity)
    , published_(published)
  {
  }
  const std::string& path() const override { return path_; }
  Result<void> append(const std::byte*, std::size_t size) override
  {
    if (size > capacity_ - used_)
    {
      return makeError(Error::Kind::Unwritable, "full");
    }
    used_ += size;
    return {};
  }
  Result<void> overwrite(std::uint64_t, const std::byte*, std::size_t) override { return {}; }
  Result<void> publish() override
  {
    published_ = true;
    return {};
  }

private:
  std::string path_ = "small disk";
  std::uint64_t capacity_;
  std::uint64_t used_ = 0;
  bool& published_;
};

std::unique_ptr<StoreWriter> makeWriter(const std::string& path, const AttributeSchema& schema)
{
  auto writer = StoreWriter::create(path, schema);
  EXPECT_TRUE(writer) << writer.error().what;
  return writer ? std::move(*writer) : nullptr;
}

Error commitFails(SampleStore sample, std::vector<StoreWriter::PayloadId> payloads)
{
  const std::string path = temporaryPath("refused.pfront");
  const auto writer = makeWriter(path, sample.description.schema);
  for (const NodeColumns& points : sample.points)
  {
    EXPECT_TRUE(writer->append(encodeNode(points, sample.description.schema)));
  }
  const auto done = writer->commit(sample.description, sample.nodes, sample.roots, payloads);
  EXPECT_FALSE(done);
  EXPECT_FALSE(fs::exists(path));
  return done ? Error{} : done.error();
}
} // namespace

TEST(StoreWriter, IsWholeOrAbsent)
{
  const SampleStore sample = makeSample(200);
  const std::string path = temporaryPath("a.pfront");
  {
    const auto writer = makeWriter(path, sample.description.schema);
    ASSERT_TRUE(writer->append(encodeNode(sample.points[0], sample.description.schema)));
    EXPECT_EQ(filesInTheMaking(path).size(), 1u);
    EXPECT_FALSE(fs::exists(path));
  }
  EXPECT_TRUE(filesInTheMaking(path).empty());
  EXPECT_FALSE(fs::exists(path));
  writeSample(sample, path);
  EXPECT_TRUE(filesInTheMaking(path).empty());
  EXPECT_TRUE(fs::exists(path));
  // A second writer that gives up leaves the first one's store.
  const std::vector<std::byte> before = fileBytes(path);
  makeWriter(path, sample.description.schema).reset();
  EXPECT_EQ(fileBytes(path), before);
}

TEST(StoreWriter, PayloadsComeInAnyOrder)
{
  const SampleStore sample = makeSample(200);
  const std::string path = temporaryPath("a.pfront");
  const auto writer = makeWriter(path, sample.description.schema);
  std::vector<StoreWriter::PayloadId> payloads(sample.nodes.size());
  for (std::size_t i = sample.nodes.size(); i-- > 0;)
  {
    const auto id = writer->append(encodeNode(sample.points[i], sample.description.schema));
    ASSERT_TRUE(id);
    payloads[i] = *id;
  }
  const auto done = writer->commit(sample.description, sample.nodes, sample.roots, payloads);
  ASSERT_TRUE(done) << done.error().what;
  EXPECT_EQ(writer->bytesWritten(), fs::file_size(path));
  const auto store = PointStore::open(path);
  ASSERT_TRUE(store);
  EXPECT_TRUE((*store)->verify()->ok);
  EXPECT_EQ((*store)->read(5, {})->positions, sample.points[5].positions);
}

TEST(StoreWriter, FullDiskIsToldAtEveryByte)
{
  const SampleStore sample = makeSample(3);
  const std::string path = temporaryPath("a.pfront");
  writeSample(sample, path);
  const std::uint64_t needed = fs::file_size(path);
  for (std::uint64_t capacity = 0; capacity <= needed;
       capacity += capacity + 700 < needed ? 700 : 1)
  {
    bool published = false;
    auto writer =
      assembleStore(std::make_unique<SmallDisk>(capacity, published), sample.description.schema);
    const Result<void> done = writer ? writeSample(sample, **writer) : writer.error();
    ASSERT_EQ(bool(done), capacity == needed);
    ASSERT_EQ(published, capacity == needed);
    if (!done)
    {
      ASSERT_EQ(done.error().kind, Error::Kind::Unwritable);
    }
  }
}

// The operating system's own refusal: a limit on the size of files, in a process of its own.
TEST(StoreWriter, FullDiskLeavesNothing)
{
  const SampleStore sample = makeSample(2000);
  const std::string path = temporaryPath("a.pfront");
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0)
  {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{ 100000, 100000 };
    setrlimit(RLIMIT_FSIZE, &limit);
    auto writer = StoreWriter::create(path, sample.description.schema);
    const Result<void> done = writer ? writeSample(sample, **writer) : writer.error();
    writer = makeError(Error::Kind::Cancelled, "destroyed");
    const bool told = !done && done.error().kind == Error::Kind::Unwritable &&
      done.error().what.find("bytes could not be written after byte 100000") != std::string::npos;
    _exit(told && !fs::exists(path) && filesInTheMaking(path).empty() ? 0 : 1);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

TEST(StoreWriter, KilledBuildBlocksNothingAndOpensNowhere)
{
  const SampleStore sample = makeSample(50000);
  const std::string path = temporaryPath("a.pfront");
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0)
  {
    auto writer = StoreWriter::create(path, sample.description.schema);
    for (const NodeColumns& points : sample.points)
    {
      const EncodedNode node = encodeNode(points, sample.description.schema);
      if (!writer || !(*writer)->append(node) || !(*writer)->appendLate(node))
      {
        _exit(1);
      }
    }
    raise(SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  const std::vector<std::string> left = filesInTheMaking(path);
  ASSERT_EQ(left.size(), 1u) << "late payloads have no file with a name";
  ASSERT_GT(fs::file_size(left[0]), 1000000u);
  EXPECT_FALSE(PointStore::open(left[0]));
  EXPECT_FALSE(PointStore::looksLikeStore(left[0]));
  const SampleStore smaller = makeSample(10);
  writeSample(smaller, path);
  EXPECT_TRUE(filesInTheMaking(path).empty());
  const auto store = PointStore::open(path);
  ASSERT_TRUE(store) << store.error().what;
  EXPECT_TRUE((*store)->verify()->ok);
}

TEST(StoreWriter, TwoAtOnceDoNotMix)
{
  const SampleStore sample = makeSample(10);
  const std::string path = temporaryPath("a.pfront");
  const auto first = makeWriter(path, sample.description.schema);
  const auto second = StoreWriter::create(path, sample.description.schema);
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().kind, Error::Kind::Unwritable);
  EXPECT_NE(second.error().what.find("another process is writing it"), std::string::npos);
  EXPECT_TRUE(writeSample(sample, *first));
}

TEST(StoreWriter, NamesThePlaceItCannotWriteTo)
{
  const AttributeSchema schema;
  const std::string nowhere = temporaryPath("no") + "/folder/a.pfront";
  const auto absent = StoreWriter::create(nowhere, schema);
  ASSERT_FALSE(absent);
  EXPECT_EQ(absent.error().kind, Error::Kind::Unwritable);
  EXPECT_NE(absent.error().what.find("does not exist"), std::string::npos);
  const auto folder = StoreWriter::create(testing::TempDir(), schema);
  ASSERT_FALSE(folder);
  EXPECT_EQ(folder.error().kind, Error::Kind::Unwritable);
}

TEST(StoreWriter, RefusesATableThatIsNotATree)
{
  const std::vector<StoreWriter::PayloadId> all{ 0, 1, 2, 3, 4, 5, 6 };
  SampleStore wrongLevel = makeSample(10);
  wrongLevel.nodes[5].level = 7;
  EXPECT_EQ(commitFails(wrongLevel, all).kind, Error::Kind::BadArgument);
  SampleStore wrongCount = makeSample(10);
  wrongCount.nodes[3].pointCount = 11;
  EXPECT_EQ(commitFails(wrongCount, all).kind, Error::Kind::BadArgument);
  SampleStore wrongRoots = makeSample(10);
  wrongRoots.roots = { 0 };
  EXPECT_EQ(commitFails(wrongRoots, all).kind, Error::Kind::BadArgument);
  EXPECT_EQ(commitFails(makeSample(10), { 0, 1, 2, 3, 4, 5, 5 }).kind, Error::Kind::BadArgument);
  EXPECT_EQ(commitFails(makeSample(10), { 0, 1, 2, 3, 4, 5, 7 }).kind, Error::Kind::BadArgument);
  EXPECT_EQ(commitFails(makeSample(10), { 0, 1, 2, 3, 4, 5 }).kind, Error::Kind::BadArgument);
}

TEST(StoreWriter, EmptyStoreAndNoAttributes)
{
  StoreDescription description;
  description.structure = "octree";
  const std::string path = temporaryPath("a.pfront");
  const auto writer = makeWriter(path, description.schema);
  ASSERT_TRUE(writer->commit(description, {}, {}, {}));
  const auto store = PointStore::open(path);
  ASSERT_TRUE(store) << store.error().what;
  EXPECT_EQ((*store)->hierarchy()->nodeCount(), 0u);
  EXPECT_TRUE((*store)->description().bounds.empty());
  EXPECT_TRUE((*store)->verify()->ok);
}

} // namespace pointfront
