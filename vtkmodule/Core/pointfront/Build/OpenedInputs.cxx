#include "pointfront/Build/OpenedInputs.h"

#include "pointfront/Export/OutputTarget.h"

#include <algorithm>

namespace pointfront
{
namespace
{
Result<void> readAll(const PointSource& source, const SurveyOptions& options)
{
  return forEachChunk(source.chunkCount(), options,
    [&source](std::uint64_t chunk) -> Result<void>
    {
      PointBatch batch;
      return source.readSteps(chunk, batch);
    });
}

Result<std::unique_ptr<PointSource>> opened(const std::string& path, const PointFileOpener& opener,
  OnFault onFault, const SurveyOptions& options)
{
  Result<std::unique_ptr<PointSource>> source = opener.open(path);
  if (source && onFault == OnFault::Skip)
  {
    if (Result<void> read = readAll(**source, options); !read)
    {
      return read.error();
    }
  }
  return source;
}

/// Sources that refer to a file which another one reads: an index and its LAS file.
std::vector<Error> readTwice(const PointSources& sources)
{
  std::vector<Error> faults;
  for (const auto& source : sources)
  {
    const SourceDescription& description = source->description();
    const auto reads = [&description](const std::unique_ptr<PointSource>& other)
    {
      return other->description().furtherFiles.empty() &&
        sameFile(other->description().path, description.path);
    };
    if (!description.furtherFiles.empty() && std::any_of(sources.begin(), sources.end(), reads))
    {
      faults.push_back(makeError(Error::Kind::BadArgument,
        description.furtherFiles.front() + ": stands for '" + description.path +
          "', which is an input too; name one of them, or each point is stored twice"));
    }
  }
  return faults;
}
} // namespace

Error faultyInputs(const std::vector<Error>& faults, std::size_t inputs)
{
  if (faults.size() == 1 && inputs == 1)
  {
    return faults.front();
  }
  std::string what = std::to_string(faults.size()) + " of " + std::to_string(inputs) +
    " inputs cannot be used (--on-error skip leaves them out)";
  const char* before = ": ";
  for (const Error& fault : faults)
  {
    what += before + fault.what;
    before = "; ";
  }
  return makeError(faults.front().kind, what);
}

InputFault inputFault(const std::string& path, const Error& error)
{
  const std::string prefix = path + ": ";
  const bool named = error.what.compare(0, prefix.size(), prefix) == 0;
  return { path, named ? error.what.substr(prefix.size()) : error.what };
}

Error errorOf(const InputFault& fault)
{
  return makeError(Error::Kind::NotFound, fault.path + ": " + fault.why);
}

Result<OpenedInputs> openInputs(const std::vector<std::string>& paths,
  const PointFileOpener& opener, OnFault onFault, const SurveyOptions& options,
  const std::vector<InputFault>& absent)
{
  OpenedInputs inputs;
  std::vector<Error> faults;
  for (const InputFault& fault : absent)
  {
    faults.push_back(errorOf(fault));
    inputs.skipped.push_back(fault);
  }
  for (const std::string& path : paths)
  {
    Result<std::unique_ptr<PointSource>> source = opened(path, opener, onFault, options);
    if (options.cancelled && options.cancelled())
    {
      return makeError(Error::Kind::Cancelled, "cancelled");
    }
    if (source)
    {
      inputs.sources.push_back(std::move(*source));
      continue;
    }
    if (source.error().kind == Error::Kind::Cancelled)
    {
      return source.error();
    }
    faults.push_back(source.error());
    inputs.skipped.push_back(inputFault(path, source.error()));
  }
  if (const std::vector<Error> twice = readTwice(inputs.sources); !twice.empty())
  {
    return faultyInputs(twice, paths.size()); // which one is to skip, nobody can know
  }
  if (!faults.empty() && (onFault == OnFault::Stop || inputs.sources.empty()))
  {
    return faultyInputs(faults, paths.size() + absent.size());
  }
  return inputs;
}

} // namespace pointfront
