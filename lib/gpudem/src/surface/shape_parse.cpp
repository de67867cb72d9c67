// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "surface/shape_parse.hpp"

#include "gpudem/surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace gpudem {

namespace {

struct Kind {
  const char *name;
  std::vector<const char *> value;  ///< what its values mean; "axis" is x, y or z
};
const std::vector<Kind> &kinds()
{
  static const std::vector<Kind> all = {
      {"box", {"xlo", "xhi", "ylo", "yhi", "zlo", "zhi"}},
      {"sphere", {"x", "y", "z", "radius"}},
      {"cylinder", {"axis", "c1", "c2", "radius", "lo", "hi"}},
      {"cone", {"axis", "c1", "c2", "radius at lo", "radius at hi", "lo", "hi"}},
      {"torus", {"axis", "x", "y", "z", "radius of the ring", "radius of the tube"}},
      {"plane", {"x", "y", "z", "nx", "ny", "nz", "half of the side"}},
  };
  return all;
}

std::string trimmed(const std::string &s)
{
  const std::size_t first = s.find_first_not_of(" \t"), last = s.find_last_not_of(" \t");
  return first == std::string::npos ? "" : s.substr(first, last - first + 1);
}

/// The words between the commas that stand in no inner brackets.
std::vector<std::string> splitList(const ParsedShape &p, const std::string &list)
{
  std::vector<std::string> word(1);
  int depth = 0;
  for (const char c : list) {
    depth += c == '(' ? 1 : c == ')' ? -1 : 0;
    if (depth < 0) break;
    if (c == ',' && depth == 0) word.emplace_back();
    else word.back() += c;
  }
  if (depth != 0) p.refuse("its brackets do not match");
  for (std::string &w : word) w = trimmed(w);
  return word;
}

void readValues(ParsedShape &p, const Kind &kind, const std::vector<std::string> &word)
{
  if (word.size() != kind.value.size()) {
    std::string wanted;
    for (const char *v : kind.value) wanted += (wanted.empty() ? "" : ", ") + std::string(v);
    p.refuse(fmt::format("{} takes {} values ({}), not {}", p.name, kind.value.size(), wanted, word.size()));
  }
  for (std::size_t k = 0; k < word.size(); ++k) {
    const std::string &w = word[k], what = kind.value[k];
    if (what == "axis") {
      if (w != "x" && w != "y" && w != "z") p.refuse(fmt::format("the axis is x, y or z, not '{}'", w));
      p.value.push_back(w[0] - 'x');
      continue;
    }
    char *end = nullptr;
    p.value.push_back(std::strtod(w.c_str(), &end));
    if (w.empty() || *end != '\0' || !std::isfinite(p.value.back()))
      p.refuse(fmt::format("'{}' stands where {} is expected, a number", w, what));
  }
}

void checkValues(const ParsedShape &p)
{
  const auto positive = [&](std::size_t k, const char *what) {
    if (!(p.value[k] > 0.0)) p.refuse(fmt::format("{} is {:g}, it must be above 0", what, p.value[k]));
  };
  const auto ordered = [&](std::size_t lo, std::size_t hi, const char *what) {
    if (!(p.value[lo] < p.value[hi]))
      p.refuse(fmt::format("the lower end in {} is {:g}, it must be below the upper one, {:g}", what, p.value[lo],
                           p.value[hi]));
  };
  if (p.name == "box") {
    ordered(0, 1, "x");
    ordered(2, 3, "y");
    ordered(4, 5, "z");
  } else if (p.name == "sphere") {
    positive(3, "the radius");
  } else if (p.name == "cylinder") {
    ordered(4, 5, "the direction of the axis");
    positive(3, "the radius");
  } else if (p.name == "cone") {
    ordered(5, 6, "the direction of the axis");
    if (p.value[3] < 0.0 || p.value[4] < 0.0 || p.value[3] + p.value[4] == 0.0)
      p.refuse("its radii must not be negative, and one of them above 0");
  } else if (p.name == "torus") {
    positive(4, "the radius of the ring");
    positive(5, "the radius of the tube");
    if (!(p.value[5] < p.value[4])) p.refuse("the tube must be thinner than the ring");
  } else if (p.name == "plane") {
    positive(6, "half of the side");
    if (!(p.value[3] * p.value[3] + p.value[4] * p.value[4] + p.value[5] * p.value[5] > 0.0))
      p.refuse("the normal is a vector of no length");
  }
}

void readOperands(ParsedShape &p, const std::vector<std::string> &word)
{
  if (word.size() < 2)
    p.refuse(fmt::format("{} takes two or more shapes, not {}", p.name, word.front().empty() ? 0 : word.size()));
  for (std::size_t k = 0; k < word.size(); ++k) {
    if (word[k].empty()) p.refuse(fmt::format("operand {} of {} is missing", k + 1, p.name));
    if (!isShape(word[k])) p.refuse(fmt::format("'{}' is no shape, and {} combines shapes", word[k], p.name));
    p.operand.push_back(parseShape(word[k]));
    if (p.operand.back().name == "plane")
      p.refuse(fmt::format("'{}' is an open sheet, and {} takes closed shapes; a box has planes for sides", word[k],
                           p.name));
  }
}

}  // namespace

void ParsedShape::refuse(const std::string &why) const
{
  throw Error(fmt::format("shape '{}': {}", text, why));
}

bool isOperation(const std::string &word)
{
  return word == "union" || word == "intersection" || word == "difference";
}

bool isShape(const std::string &word)
{
  const std::size_t open = word.find('(');
  return open != std::string::npos && word.find_first_not_of("abcdefghijklmnopqrstuvwxyz_ ") >= open;
}

ParsedShape parseShape(const std::string &text)
{
  ParsedShape p;
  p.text = trimmed(text);
  const std::size_t open = p.text.find('(');
  if (open == std::string::npos || p.text.back() != ')') p.refuse("it must have the form name(value,value,...)");
  p.name = trimmed(p.text.substr(0, open));
  const auto found = std::find_if(kinds().begin(), kinds().end(), [&](const Kind &k) { return p.name == k.name; });
  if (found == kinds().end() && !isOperation(p.name))
    p.refuse(
        fmt::format("'{}' is no shape; there are box, sphere, cylinder, cone, torus and plane, and their union, "
                    "intersection and difference",
                    p.name));
  const std::vector<std::string> word = splitList(p, p.text.substr(open + 1, p.text.size() - open - 2));
  if (found == kinds().end()) {
    readOperands(p, word);
  } else {
    readValues(p, *found, word);
    checkValues(p);
  }
  return p;
}

}  // namespace gpudem
