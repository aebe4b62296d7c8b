#pragma once

#include "pointfront/Points/PassChoice.h"

namespace pointfront
{

/// The passes that a choice asks for, of all families that this build carries. Passes do not know
/// each other: they are put together here.
/// Order    that in which they must run: coordinates first, then what comes from images, then what
///          comes from neighbours.
/// Errors   BadArgument: a value out of its range, an option of something that is not asked for;
///          NotFound: an image; Unsupported: this build was made without the passes that are asked
///          for, or the library that reads images is not installed.
Result<AttributePasses> chosenPasses(const PassChoice& choice);
/// Whether the images that it names can be there: its part of the errors, without opening any.
Result<void> checkImages(const PassChoice& choice);

} // namespace pointfront
