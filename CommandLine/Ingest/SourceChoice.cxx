#include "SourceChoice.h"

#include "CancelSignal.h"
#include "KnownWords.h"
#include "Values.h"

#include <algorithm>

namespace pointfront
{

void SourceChoice::declare(CLI::App& app)
{
  const auto columns = [this](const CLI::results_t& words)
  {
    columns_ = splitList(words.back());
    if (columns_.size() < 2)
    {
      throw CLI::ParseError("--columns: '" + words.back() +
          "' names no columns: write x,y,z,intensity,r,g,b,- or the like",
        2);
    }
    return true;
  };
  app
    .add_option("--columns", columns,
      "Columns of text files: x,y,z,intensity,r,g,b,- (their headers, or a guess)")
    ->type_name("LIST")
    ->expected(1);
  const auto decimal = [this](const CLI::results_t& words)
  {
    text_.decimalPoint = words.back() == "comma" || words.back() == "," ? ',' : '.';
    return true;
  };
  app
    .add_option("--decimal", decimal, "Decimal mark of text files: point or comma (by their rows)")
    ->type_name("TEXT")
    ->expected(1)
    ->check(knownWords({ "point", "comma", ".", "," }).description("{point, comma}"));
  const auto separator = [this](const CLI::results_t& words)
  {
    const std::string& word = words.back();
    text_.separator = word == "comma"  ? ','
      : word == "semicolon"            ? ';'
      : word == "tab" || word == "\\t" ? '\t'
      : word == "blank"                ? ' '
                                       : word[0];
    return true;
  };
  app
    .add_option("--separator", separator,
      "Between columns of text files: comma, semicolon, tab or blank (by their rows)")
    ->type_name("TEXT")
    ->expected(1)
    ->check(knownWords({ "comma", "semicolon", "tab", "blank", ",", ";", " ", "\t", "\\t" })
              .description("{comma, semicolon, tab, blank}"));
  app.add_option("--skip", text_.skip, "Lines at the beginning of text files to pass over (0)")
    ->transform(wholeNumber())
    ->type_name("N");
  app
    .add_option("--color-depth", colourDepth_,
      "Bits of 16-bit colours: by each file's largest (auto), 8 or 16")
    ->check(knownWords({ "auto", "8", "16" }));
}

ColourDepth SourceChoice::colourDepth() const
{
  return colourDepth_ == "8" ? ColourDepth::Eight
    : colourDepth_ == "16"   ? ColourDepth::Sixteen
                             : ColourDepth::ByFile;
}

Result<void> SourceChoice::checkAgainst(
  const std::vector<std::unique_ptr<PointSource>>& inputs) const
{
  const bool text = std::any_of(inputs.begin(), inputs.end(),
    [](const auto& input)
    {
      const std::string& format = input->description().format;
      return format == "text" || format == "PTX";
    });
  const char* const asked = !columns_.empty() ? "--columns"
    : text_.decimalPoint != '\0'              ? "--decimal"
    : text_.separator != '\0'                 ? "--separator"
    : text_.skip > 0                          ? "--skip"
                                              : nullptr;
  if (asked != nullptr && !text && !inputs.empty())
  {
    return makeError(Error::Kind::BadArgument,
      std::string(asked) + ": is for text files, and none of the inputs is one; leave it out");
  }
  return {};
}

SourceOptions SourceChoice::options(const BuildOptions& build) const
{
  SourceOptions options;
  options.columns = columns_;
  options.text = text_;
  options.survey.threads = build.threads;
  options.survey.cancelled = [] { return CancelSignal::requested(); };
  options.temporaryFolder = build.temporaryFolder;
  options.box = build.box;
  return options;
}

} // namespace pointfront
