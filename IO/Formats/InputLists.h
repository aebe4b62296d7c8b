#pragma once

#include "pointfront/Base/Result.h"

#include <string>
#include <vector>

namespace pointfront
{
class InputBox;

/// The inputs of a build, lists among them replaced by what they name.
struct ListedInputs
{
  std::vector<std::string> files;
  std::vector<std::string> warnings; ///< items of lists that name no file of points
};

/// A list that is a file here (`.pfronts`, `.vpc`, and every other STAC ItemCollection) stands for
/// the files and addresses that it names, plain LAS and LAZ among them. All else stays as it is: a
/// list behind an address is opened as one cloud. With a box, files that an ItemCollection tells to
/// lie outside are left out, and are not opened.
/// Errors  those of the lists' readers; InputBox::nothingInside() if no file is left.
Result<ListedInputs> withoutLists(
  const std::vector<std::string>& arguments, InputBox* box = nullptr);

} // namespace pointfront
