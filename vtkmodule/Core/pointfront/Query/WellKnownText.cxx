#include "pointfront/Query/WellKnownText.h"

#include "pointfront/Base/LetterCase.h"
#include "pointfront/Table/DecimalNumber.h"

#include <cmath>
#include <string>
#include <utility>

namespace pointfront
{
namespace
{

constexpr int deepestCollection = 16;

/// Reads on from a place in the text. A function that meets something else than it expects notes
/// the first fault and gives false.
class Reader
{
public:
  explicit Reader(std::string_view text)
    : text_(text)
  {
  }

  Result<PlanarGeometry> read();

private:
  bool fail(const std::string& what)
  {
    if (fault_.empty())
    {
      fault_ = what + " at byte " + std::to_string(at_);
    }
    return false;
  }
  void skipBlanks()
  {
    while (at_ < text_.size() && isAsciiSpace(text_[at_]))
    {
      ++at_;
    }
  }
  bool atEnd()
  {
    skipBlanks();
    return at_ == text_.size();
  }
  bool take(char character)
  {
    skipBlanks();
    const bool here = at_ < text_.size() && text_[at_] == character;
    at_ += here ? 1 : 0;
    return here;
  }
  bool expect(char character)
  {
    return take(character) || fail(std::string("expected '") + character + "'");
  }
  /// Letters from here on, in capitals; empty if there are none.
  std::string word()
  {
    skipBlanks();
    const std::size_t begin = at_;
    while (at_ < text_.size() && isAsciiLetter(text_[at_]))
    {
      ++at_;
    }
    return capitals(text_.substr(begin, at_ - begin));
  }
  bool number(double& value);
  bool vertex(glm::dvec2& place);
  bool line(PlanarLine& vertices);
  bool polygon(PlanarPolygon& rings);
  bool reference(PlanarGeometry& geometry);
  bool geometry(PlanarGeometry& into, int depth);
  /// ( item, item ... )
  template <typename Item>
  bool list(Item item)
  {
    if (!expect('('))
    {
      return false;
    }
    do
    {
      if (!item())
      {
        return false;
      }
    } while (take(','));
    return expect(')');
  }
  /// EMPTY, or what `read` reads.
  template <typename Read>
  bool orEmpty(Read read)
  {
    const std::size_t before = at_;
    if (word() == "EMPTY")
    {
      return true;
    }
    at_ = before;
    return read();
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::string fault_;
};

bool Reader::number(double& value)
{
  skipBlanks();
  DecimalNumber found;
  const char* const begin = text_.data() + at_;
  const char* const behind = readDecimal(begin, text_.data() + text_.size(), '.', found);
  if (behind == begin || !std::isfinite(found.value))
  {
    return fail("expected a finite number");
  }
  at_ += static_cast<std::size_t>(behind - begin);
  value = found.value;
  return true;
}

/// x, y and up to two numbers more.
bool Reader::vertex(glm::dvec2& place)
{
  double unused = 0.0;
  if (!number(place.x) || !number(place.y))
  {
    return false;
  }
  for (int more = 0; more < 2; ++more)
  {
    skipBlanks();
    if (at_ < text_.size() && text_[at_] != ',' && text_[at_] != ')' && !number(unused))
    {
      return false;
    }
  }
  return true;
}

bool Reader::line(PlanarLine& vertices)
{
  return list(
    [&]
    {
      vertices.emplace_back();
      return vertex(vertices.back());
    });
}

bool Reader::polygon(PlanarPolygon& rings)
{
  return list(
    [&]
    {
      PlanarLine ring;
      if (!line(ring))
      {
        return false;
      }
      if (ring.size() < 4 || ring.front() != ring.back())
      {
        return fail("a ring has fewer than four vertices, or does not return to its first one,");
      }
      rings.rings.push_back(std::move(ring));
      return true;
    });
}

bool Reader::reference(PlanarGeometry& geometry)
{
  double code = 0.0;
  if (!expect('=') || !number(code) || !expect(';'))
  {
    return false;
  }
  if (!(code >= 0.0 && code < 1e6) || code != std::floor(code))
  {
    return fail("an SRID that is no code");
  }
  const std::string name = "EPSG:" + std::to_string(static_cast<int>(code));
  if (!geometry.crs.empty() && geometry.crs != name)
  {
    return fail("a second SRID");
  }
  geometry.crs = code == 0.0 ? geometry.crs : name; // 0: not known
  return true;
}

bool Reader::geometry(PlanarGeometry& into, int depth)
{
  std::string kind = word();
  if (kind == "SRID" && depth == 0)
  {
    if (!reference(into))
    {
      return false;
    }
    kind = word();
  }
  // "POLYGON Z (...)" and "POLYGONZ (...)"
  const std::size_t before = at_;
  if (const std::string axes = word(); axes != "Z" && axes != "M" && axes != "ZM")
  {
    at_ = before;
  }
  while (!kind.empty() && (kind.back() == 'Z' || kind.back() == 'M'))
  {
    kind.pop_back();
  }
  if (kind == "POLYGON" || kind == "TRIANGLE" || kind == "MULTIPOLYGON")
  {
    const auto one = [&]
    {
      PlanarPolygon rings;
      const bool done = orEmpty([&] { return polygon(rings); });
      into.polygons.push_back(std::move(rings));
      return done;
    };
    return kind == "MULTIPOLYGON" ? orEmpty([&] { return list(one); }) : one();
  }
  if (kind == "LINESTRING" || kind == "MULTILINESTRING")
  {
    const auto one = [&]
    {
      PlanarLine vertices;
      const bool done = orEmpty([&] { return line(vertices); });
      if (!vertices.empty())
      {
        into.lines.push_back(std::move(vertices));
      }
      return done;
    };
    return kind == "MULTILINESTRING" ? orEmpty([&] { return list(one); }) : one();
  }
  if (kind == "GEOMETRYCOLLECTION" && depth < deepestCollection)
  {
    return orEmpty([&] { return list([&] { return geometry(into, depth + 1); }); });
  }
  return fail(kind.empty() ? std::string("expected a geometry")
                           : "'" + kind + "' is neither an area nor a line");
}

Result<PlanarGeometry> Reader::read()
{
  PlanarGeometry geometry;
  bool sound = !atEnd() || fail("no geometry");
  while (sound && !atEnd())
  {
    sound = this->geometry(geometry, 0);
    take(';');
  }
  if (!sound)
  {
    return makeError(Error::Kind::BadFormat, "not well-known text: " + fault_);
  }
  return geometry;
}

} // namespace

Result<PlanarGeometry> parseWellKnownText(std::string_view text)
{
  constexpr std::string_view byteOrderMark = "\xef\xbb\xbf";
  if (text.substr(0, byteOrderMark.size()) == byteOrderMark)
  {
    text.remove_prefix(byteOrderMark.size());
  }
  return Reader(text).read();
}

} // namespace pointfront
