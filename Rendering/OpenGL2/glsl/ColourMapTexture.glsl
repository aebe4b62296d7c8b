// A colour map as a row of texels: [0] below the range, [1 .. n] the map, [n + 1] above the range,
// [n + 2] not a number, or none of the map's. Editing the map changes this texture and no point.
uniform sampler2D colourTable;
uniform int tableSize;      // n
uniform float tableShift;   // added to a value: to the range's low end, or to 0 (logarithmic)
uniform float tableScale;   // entries per unit, or per decade (logarithmic)
uniform float tableLogLow;  // log10 of the low end
uniform int tableScaling;   // 0: linear, 1: logarithmic, 2: an entry for each whole number
uniform int tableLowSteps;  // the low end in grid steps from the reference point, of heights
uniform float tableLowRest; // its rounding, store units
const float entriesBegin = 1.0 / 512.0; // early, in entries; as ColourMap.cxx

/// A whole number's texel.
int codeTexel(float place)
{
  float code = floor(place + 0.5);
  bool known = abs(place - code) <= entriesBegin && code >= 0.0 && code < float(tableSize);
  return known ? int(code) + 1 : tableSize + 2;
}

int entryTexel(float entry)
{
  float n = float(tableSize);
  float slack = 1e-6 * n; // both ends of the range belong to it, however they were rounded
  int texel = entry < -slack ? 0 : (entry > n + slack ? tableSize + 1 : 1);
  return texel == 1 ? 1 + clamp(int(floor(entry + entriesBegin)), 0, tableSize - 1) : texel;
}

vec4 entryColour(float entry)
{
  int texel = tableScaling == 2 ? codeTexel(entry) : entryTexel(entry);
  return texelFetch(colourTable, ivec2(texel, 0), 0);
}

/// Colour of a value. Twin: pointfront::ColourMap::at.
vec4 tableColour(float value)
{
  float entry = (value + tableShift) * tableScale;
  if (tableScaling == 1)
  {
    float positive = value + tableShift;
    entry = positive > 0.0 ? (log(positive) / log(10.0) - tableLogLow) * tableScale : -1.0;
  }
  return isnan(value) ? texelFetch(colourTable, ivec2(tableSize + 2, 0), 0) : entryColour(entry);
}

/// Colour of a height `steps` and `rest` above the frame's reference point. Steps are counted from
/// the range's low end in integers: floats of heights far below the eye are coarser than an entry.
vec4 heightColour(int steps, int shift, float stepSize, float rest)
{
  bool exact = tableScaling != 1 && shift == 0 && abs(steps) < 1 << 30;
  return exact
    ? entryColour((float(steps - tableLowSteps) * stepSize + (rest + tableLowRest)) * tableScale)
    : tableColour(float(steps) * (stepSize * exp2(float(shift))) + rest);
}
