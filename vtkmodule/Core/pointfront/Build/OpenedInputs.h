#pragma once

#include "pointfront/Points/AttributePass.h"
#include "pointfront/Points/PointFileOpener.h"
#include "pointfront/Table/ParallelChunks.h"

#include <string>
#include <vector>

namespace pointfront
{

/// The behaviour of a build if an input is no point file, is damaged or holds no position.
enum class OnFault
{
  Stop, ///< nothing is written; the Error names all inputs that are wrong
  Skip ///< it is left out, named and counted
};

/// An input that is left out.
struct InputFault
{
  std::string path;
  std::string why;
};

struct OpenedInputs
{
  PointSources sources;
  std::vector<InputFault> skipped;
};

/// The faults of some of `inputs` inputs as one Error, of the first one's kind: each is named.
Error faultyInputs(const std::vector<Error>& faults, std::size_t inputs);
/// For a list: what begins with the path does not name it twice.
InputFault inputFault(const std::string& path, const Error& error);
/// Back to an Error: of a fault that was listed.
Error errorOf(const InputFault& fault);

/// Opens point files. With OnFault::Skip every chunk of them is read once before, so that a file
/// whose end is damaged is left out as a whole: that costs as long as reading takes.
/// Errors  Cancelled; faultyInputs() if any is wrong (Stop), or all are (Skip).
/// Threads called from one thread; a trial read runs its own.
/// `absent`  inputs that were looked for in vain: wrong like the others.
Result<OpenedInputs> openInputs(const std::vector<std::string>& paths,
  const PointFileOpener& opener, OnFault onFault, const SurveyOptions& options = {},
  const std::vector<InputFault>& absent = {});

} // namespace pointfront
