#include "pointfront/InPlace/ForeignNodes.h"

namespace pointfront
{

std::vector<Result<RawBytes>> ForeignNodes::fetchAll(
  const std::vector<ForeignNode>& nodes, const ReadStop& stop) const
{
  std::vector<Result<RawBytes>> fetched;
  for (const ForeignNode& node : nodes)
  {
    fetched.push_back(
      stop ? makeError(Error::Kind::Cancelled, "nobody wants this node now") : fetch(node));
  }
  return fetched;
}

std::vector<Result<ForeignPage>> ForeignNodes::readPages(
  const std::vector<ForeignNode>& pages) const
{
  return std::vector<Result<ForeignPage>>(pages.size(),
    Result<ForeignPage>(makeError(Error::Kind::Unsupported, "its hierarchy has no pages")));
}

} // namespace pointfront
