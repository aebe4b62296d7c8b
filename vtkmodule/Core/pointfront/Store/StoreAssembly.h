#pragma once

#include "pointfront/Disk/OutputFile.h"
#include "pointfront/Store/StoreWriter.h"

#include <memory>
#include <optional>

namespace pointfront
{

/// Errors  BadArgument: a store has no room for so many attributes.
Result<void> checkColumnCount(const AttributeSchema& schema);

/// A StoreWriter on a file of the caller's choice: StoreWriter::create() opens a real one, tests
/// give one that fails. `elsewhere`: of createReferring().
Result<std::unique_ptr<StoreWriter>> assembleStore(std::unique_ptr<OutputFile> file,
  const AttributeSchema& schema, std::optional<WrittenPayloads> elsewhere = std::nullopt);

} // namespace pointfront
