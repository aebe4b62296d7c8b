#include "TextGuess.h"

#include "pointfront/Table/FieldStatistics.h"

#include <cmath>

namespace pointfront
{
namespace
{
constexpr double mostOfUnit = 0.02; // how far normals printed with two digits are from length 1

/// The first rows of a file, column by column.
class Guess
{
public:
  Guess(const std::vector<std::vector<double>>& rows, std::size_t columns)
    : rows_(rows)
  {
    for (std::size_t c = 0; c < columns; ++c)
    {
      std::size_t numbers = 0;
      std::size_t cells = 0;
      for (const std::vector<double>& row : rows)
      {
        cells += c < row.size() ? 1 : 0;
        numbers += c < row.size() && !std::isnan(row[c]) ? 1 : 0;
      }
      const bool numeric = numbers > 0 && numbers * 2 >= cells;
      names_.push_back(numeric ? "column_" + std::to_string(c + 1) : "-");
      if (numeric)
      {
        numeric_.push_back(c);
      }
    }
    statistics_.resize(names_.size());
    for (const std::vector<double>& row : rows)
    {
      for (std::size_t c = 0; c < names_.size() && c < row.size(); ++c)
      {
        statistics_[c].add(row[c]);
      }
    }
  }

  std::vector<std::string> names();

private:
  std::size_t left(std::size_t i) const { return numeric_.size() - i; }
  bool isNormal(std::size_t i) const;
  bool isColour(std::size_t i) const;
  void name(std::size_t i, const std::vector<std::string>& names)
  {
    for (std::size_t k = 0; k < names.size(); ++k)
    {
      names_[numeric_[i + k]] = names[k];
    }
  }

  const std::vector<std::vector<double>>& rows_;
  std::vector<std::string> names_;
  std::vector<std::size_t> numeric_; ///< columns of numbers
  std::vector<FieldStatistics> statistics_;
};

bool Guess::isNormal(std::size_t i) const
{
  if (i + 3 > numeric_.size())
  {
    return false;
  }
  std::size_t unit = 0;
  for (const std::vector<double>& row : rows_)
  {
    double square = 0.0;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const std::size_t c = numeric_[i + k];
      square += c < row.size() ? row[c] * row[c] : 0.0;
    }
    unit += std::abs(std::sqrt(square) - 1.0) <= mostOfUnit ? 1 : 0;
  }
  return unit * 10 >= rows_.size() * 9;
}

bool Guess::isColour(std::size_t i) const
{
  if (i + 3 > numeric_.size())
  {
    return false;
  }
  FieldStatistics all;
  for (std::size_t k = 0; k < 3; ++k)
  {
    all.add(statistics_[numeric_[i + k]]);
  }
  const bool inRange = !all.empty() && all.low >= 0.0 && all.high <= 65535.0;
  return inRange && (all.whole || all.high <= 1.0) && !isNormal(i);
}

std::vector<std::string> Guess::names()
{
  static const char* const axes[3] = { "x", "y", "z" };
  std::size_t i = 0;
  for (; i < 3 && i < numeric_.size(); ++i)
  {
    names_[numeric_[i]] = axes[i];
  }
  bool colour = false;
  bool normal = false;
  bool intensity = false;
  while (i < numeric_.size())
  {
    // x y z i r g b: where all four are integers, the odd one is in front.
    const bool oneInFront = !intensity && (left(i) - 1) % 3 == 0 && isColour(i + 1);
    if (!colour && isColour(i) && !oneInFront)
    {
      name(i, { "red", "green", "blue" });
      colour = true;
      i += 3;
    }
    else if (!normal && isNormal(i))
    {
      name(i, { "nx", "ny", "nz" });
      normal = true;
      i += 3;
    }
    else
    {
      const bool beside = left(i) == 1 || isColour(i + 1) || isNormal(i + 1);
      if (!intensity && beside)
      {
        name(i, { "intensity" });
        intensity = true;
      }
      ++i;
    }
  }
  return names_;
}
} // namespace

std::vector<std::string> guessColumns(
  const std::vector<std::vector<double>>& rows, std::size_t columns)
{
  return rows.empty() ? std::vector<std::string>() : Guess(rows, columns).names();
}

} // namespace pointfront
