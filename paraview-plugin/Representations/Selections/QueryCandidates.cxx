#include "QueryCandidates.h"

#include "pointfront/Store/StoredCloud.h"

#include "vtkAbstractArray.h"
#include "vtkCommand.h"
#include "vtkDoubleArray.h"
#include "vtkExecutive.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointFrontExtract.h"
#include "vtkPointFrontReader.h"
#include "vtkPointFrontStore.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <iomanip>
#include <iterator>
#include <limits>
#include <locale>
#include <optional>
#include <regex>
#include <sstream>
#include <vector>

namespace pointfront
{
namespace
{

/// Keeps what an error says.
class ErrorText final : public vtkCommand
{
public:
  static ErrorText* New() { return new ErrorText; }
  void Execute(vtkObject*, unsigned long, void* data) override
  {
    this->Text = static_cast<const char*>(data);
    const std::size_t object = this->Text.find("): ");
    this->Text = object == std::string::npos ? this->Text : this->Text.substr(object + 3);
    const std::size_t end = this->Text.find_last_not_of('\n');
    this->Text = this->Text.substr(0, end == std::string::npos ? 0 : end + 1);
  }
  std::string Text;
};

std::string trimmed(const std::string& text)
{
  const std::size_t first = text.find_first_not_of(" \t\n");
  const std::size_t last = text.find_last_not_of(" \t\n");
  return first == std::string::npos ? std::string() : text.substr(first, last - first + 1);
}

/// Without brackets that enclose all of it.
std::string unbracketed(std::string text)
{
  for (text = trimmed(text); text.size() > 1 && text.front() == '(' && text.back() == ')';)
  {
    int depth = 0;
    for (std::size_t i = 0; i + 1 < text.size(); ++i)
    {
      depth += text[i] == '(' ? 1 : text[i] == ')' ? -1 : 0;
      if (depth == 0)
      {
        return text; // the first closes before the end
      }
    }
    text = trimmed(text.substr(1, text.size() - 2));
  }
  return text;
}

/// The parts between "&" outside of brackets.
std::vector<std::string> conjuncts(const std::string& query)
{
  std::vector<std::string> parts(1);
  int depth = 0;
  for (const char c : query)
  {
    depth += c == '(' ? 1 : c == ')' ? -1 : 0;
    if (c == '&' && depth == 0)
    {
      parts.emplace_back();
    }
    else
    {
      parts.back() += c;
    }
  }
  return parts;
}

bool isOneNumberOf(const std::string& name, const StoreDescription& store)
{
  for (const Attribute& attribute : store.schema)
  {
    if (attribute.name == name)
    {
      return attribute.components == 1;
    }
  }
  return name == "elevation";
}

/// "intensity in [99.9, inf]" for "intensity >= 100"; nothing if it is no such comparison.
std::optional<std::string> conditionOfComparison(
  const std::string& text, const StoreDescription& store)
{
  const std::size_t sign = text.find_first_of("=<>!");
  if (sign == std::string::npos)
  {
    return std::nullopt;
  }
  const std::size_t rest = text.find_first_not_of("=<>!", sign);
  const std::string name = trimmed(text.substr(0, sign));
  const std::string comparison = text.substr(sign, rest - sign);
  const std::string number = rest == std::string::npos ? "" : trimmed(text.substr(rest));
  std::istringstream digits(number); // whatever the locale's decimal point is
  digits.imbue(std::locale::classic());
  double value = 0.0;
  const bool isNumber = (digits >> value) && digits.peek() == EOF && std::isfinite(value) &&
    number.find_first_not_of("+-.0123456789eE") == std::string::npos;
  if (!isNumber || !isOneNumberOf(name, store))
  {
    return std::nullopt;
  }
  const double margin = 1e-6 * std::abs(value) + std::numeric_limits<float>::min();
  std::ostringstream low;
  std::ostringstream high;
  low.imbue(std::locale::classic());
  high.imbue(std::locale::classic());
  low << std::setprecision(17) << value - margin;
  high << std::setprecision(17) << value + margin;
  if (comparison == "==")
  {
    return name + " in [" + low.str() + ", " + high.str() + "]";
  }
  if (comparison == "<" || comparison == "<=")
  {
    return name + " <= " + high.str();
  }
  if (comparison == ">" || comparison == ">=")
  {
    return name + " >= " + low.str();
  }
  return std::nullopt;
}

} // namespace

bool asksForValues(vtkSelection* selection)
{
  if (selection->GetExpression().find('!') != std::string::npos)
  {
    return true; // all but what is selected: "Invert Selection" of ParaView's appended selections
  }
  int frusta = 0;
  int lists = 0;
  for (unsigned int i = 0; i < selection->GetNumberOfNodes(); ++i)
  {
    vtkSelectionNode* node = selection->GetNode(i);
    const char* query = node->GetQueryString();
    const int content = node->GetContentType();
    vtkAbstractArray* list = node->GetSelectionList();
    const bool named = list && list->GetName() && std::string(list->GetName()) == "point_id";
    vtkInformation* properties = node->GetProperties();
    const bool inverted =
      properties->Has(vtkSelectionNode::INVERSE()) && properties->Get(vtkSelectionNode::INVERSE());
    if ((query && *query) || content == vtkSelectionNode::QUERY ||
      content == vtkSelectionNode::THRESHOLDS || (content == vtkSelectionNode::VALUES && !named) ||
      (inverted && content != vtkSelectionNode::INDICES))
    {
      return true;
    }
    frusta += content == vtkSelectionNode::FRUSTUM ? 1 : 0;
    lists += content == vtkSelectionNode::GLOBALIDS || named ? 1 : 0;
  }
  return frusta > 1 || (frusta == 1 && lists > 0);
}

bool choosesStoredPoints(vtkSelection* selection)
{
  constexpr int contents[] = { vtkSelectionNode::GLOBALIDS, vtkSelectionNode::VALUES,
    vtkSelectionNode::THRESHOLDS, vtkSelectionNode::QUERY, vtkSelectionNode::FRUSTUM };
  for (unsigned int i = 0; i < selection->GetNumberOfNodes(); ++i)
  {
    vtkSelectionNode* node = selection->GetNode(i);
    const char* query = node->GetQueryString();
    if (!(query && *query) &&
      std::find(std::begin(contents), std::end(contents), node->GetContentType()) ==
        std::end(contents))
    {
      return false;
    }
  }
  return selection->GetNumberOfNodes() > 0;
}

bool namesRows(vtkSelection* selection)
{
  for (unsigned int i = 0; i < selection->GetNumberOfNodes(); ++i)
  {
    if (selection->GetNode(i)->GetContentType() == vtkSelectionNode::INDICES)
    {
      return true;
    }
  }
  return false;
}

bool asksForRows(vtkSelection* selection, const StoreDescription& store)
{
  for (const Attribute& attribute : store.schema)
  {
    if (attribute.name == "id")
    {
      return false;
    }
  }
  const std::regex row("\\bid\\b");
  for (unsigned int i = 0; i < selection->GetNumberOfNodes(); ++i)
  {
    const char* query = selection->GetNode(i)->GetQueryString();
    if (query && std::regex_search(query, row))
    {
      return true;
    }
  }
  return false;
}

std::string conditionOfQuery(const std::string& query, const StoreDescription& store)
{
  const std::vector<std::string> parts = conjuncts(unbracketed(query));
  std::string condition;
  for (const std::string& part : parts)
  {
    // "&" binds tighter than a comparison: parts without brackets mean something else.
    const std::string whole = trimmed(part);
    const bool bracketed = parts.size() == 1 || (!whole.empty() && whole.front() == '(');
    const std::optional<std::string> one =
      bracketed ? conditionOfComparison(unbracketed(whole), store) : std::nullopt;
    if (!one)
    {
      return {};
    }
    condition += (condition.empty() ? "" : " and ") + *one;
  }
  return condition;
}

std::string conditionOfSelection(vtkSelection* selection, const StoreDescription& store)
{
  if (selection->GetNumberOfNodes() != 1 || !selection->GetExpression().empty())
  {
    return {};
  }
  vtkSelectionNode* node = selection->GetNode(0);
  vtkInformation* properties = node->GetProperties();
  const bool inverted =
    properties->Has(vtkSelectionNode::INVERSE()) && properties->Get(vtkSelectionNode::INVERSE());
  const bool plain = node->GetContentType() == vtkSelectionNode::QUERY &&
    node->GetFieldType() == vtkSelectionNode::POINT && node->GetQueryString() && !inverted;
  return plain ? conditionOfQuery(node->GetQueryString(), store) : std::string();
}

bool readCandidates(vtkPointFrontReader* reader, const std::string& condition, vtkIdType mostPoints,
  int piece, int pieces, vtkPolyData* output, std::string& error)
{
  vtkNew<vtkPointFrontExtract> extract;
  vtkNew<ErrorText> told;
  extract->AddObserver(vtkCommand::ErrorEvent, told);
  vtkNew<ErrorText> ofPipeline; // says that there was one
  extract->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, ofPipeline);
  extract->SetFileName(reader->GetStore()->GetFileName());
  extract->SetWhere(condition.empty() ? nullptr : condition.c_str());
  extract->SetMaximumNumberOfPoints(mostPoints);
  for (int i = 0; i < reader->GetNumberOfPointArrays(); ++i)
  {
    const char* name = reader->GetPointArrayName(i);
    extract->SetPointArrayStatus(name, reader->GetPointArrayStatus(name));
  }
  extract->UpdatePiece(piece, pieces, 0);
  if (!told->Text.empty())
  {
    // The filter's property for the setting.
    error = std::regex_replace(
      told->Text, std::regex("MaximumNumberOfPoints"), "Most Selection Points (Settings)");
    return false;
  }
  output->ShallowCopy(extract->GetOutput());
  vtkPointData* attributes = output->GetPointData();
  if (!attributes->HasArray("elevation"))
  {
    const vtkIdType points = output->GetNumberOfPoints();
    vtkNew<vtkDoubleArray> elevation;
    elevation->SetName("elevation");
    elevation->SetNumberOfValues(points);
    for (vtkIdType i = 0; i < points; ++i)
    {
      double place[3];
      output->GetPoint(i, place);
      elevation->SetValue(i, place[2]);
    }
    attributes->AddArray(elevation);
  }
  return true;
}

} // namespace pointfront
