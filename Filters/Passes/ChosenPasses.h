#pragma once

#include "pointfront/Points/PassChoice.h"

namespace pointfront
{

/// The passes that this build carries, put together. A library of its own: a process that loads it
/// has them as AttributePassMaker::ofProcess().
class ChosenPasses final : public AttributePassMaker
{
public:
  Result<AttributePasses> passes(const PassChoice& choice) const override;
};

} // namespace pointfront
