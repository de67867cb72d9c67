// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "material_file.h"

#include "comm.h"
#include "error.h"
#include "gpudem/errors.h"
#include "lammps.h"
#include "update.h"
#include "utils.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

using namespace LAMMPS_NS;
using gpudem::Material;
using gpudem::MaterialLaw;
using gpudem::MaterialPair;
using gpudem::ModelSlot;
using gpudem::NumberOf;

namespace {

std::vector<std::string> split(const std::string &list, char separator)
{
  std::vector<std::string> parts;
  std::istringstream stream(list);
  for (std::string part; std::getline(stream, part, separator);)
    if (!part.empty()) parts.push_back(part);
  return parts;
}

/// Folders in which to look for a file that is not there by its name: those of LAMMPS and of ours from the environment,
/// then those known to the build. utils::get_potential_file_path() will not do: Debian's liblammps has a fixed folder
/// in place of LAMMPS_POTENTIALS.
std::vector<std::string> folders()
{
  std::vector<std::string> all;
  const auto add = [&](const char *list) {
    for (const std::string &folder : split(list ? list : "", ':')) all.push_back(folder);
  };
  add(std::getenv("LAMMPS_POTENTIALS"));
  add(std::getenv("GPUDEM_POTENTIALS"));
#ifdef GPUDEM_POTENTIALS_PATH
  add(GPUDEM_POTENTIALS_PATH);
#endif
  return all;
}

/// Empty if there is none.
std::string find(const std::string &name)
{
  if (utils::file_is_readable(name)) return name;
  for (const std::string &folder : folders()) {
    const std::string path = utils::path_join(folder, utils::path_basename(name));
    if (utils::file_is_readable(path)) return path;
  }
  return "";
}

bool isNumber(const std::string &word)
{
  char *end = nullptr;
  std::strtod(word.c_str(), &end);
  return utils::is_double(word) && *end == '\0';
}

/// The word behind \p label in the comment of the first line.
std::string field(const std::vector<std::string> &words, const std::string &label)
{
  const auto at = std::find(words.begin(), words.end(), label);
  return at == words.end() || at + 1 == words.end() ? "" : *(at + 1);
}

bool isLawNumber(const std::string &word)
{
  const auto &all = gpudem::lawNumbers();
  return std::any_of(all.begin(), all.end(), [&](const NumberOf<MaterialLaw> &n) { return word == n.info.name; });
}

template <class Of>
std::string listed(const std::vector<NumberOf<Of>> &numbers)
{
  std::vector<std::string> names;
  for (const NumberOf<Of> &n : numbers) names.push_back(n.needed ? n.info.name : fmt::format("[{}]", n.info.name));
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

bool MaterialFile::isName(const std::string &word)
{
  return utils::strmatch(word, "\\.gran$");
}

MaterialFile::MaterialFile(LAMMPS *lmp, const std::string &command, const std::string &name)
    : lmp_(lmp), command_(command), name_(name)
{
  const std::string all = text();
  std::istringstream stream(all);
  for (std::string line; std::getline(stream, line);) {
    if (++line_ == 1) checkHeader(line);
    const std::vector<std::string> words = utils::split_words(utils::trim_comment(line));
    if (!words.empty()) readLine(words);
  }
  if (line_ == 0) fail("is empty or cannot be read");
  if (materials_.empty()) fail("has no line 'material NAME ...'");
  checkPairs();
}

void MaterialFile::fail(const std::string &what) const
{
  lmp_->error->all(FLERR, fmt::format("{}: material file {} {}", command_, path_.empty() ? name_ : path_, what));
}

void MaterialFile::failAt(int line, const std::string &what) const
{
  lmp_->error->all(FLERR, fmt::format("{}: material file {}, line {}: {}", command_, path_, line, what));
}

void MaterialFile::failLine(const std::string &what) const
{
  failAt(line_, what);
}

/// The text of the file, which the first rank reads.
std::string MaterialFile::text()
{
  std::string all;
  int length[2] = {0, 0};
  if (lmp_->comm->me == 0) {
    path_ = find(name_);
    std::ifstream file(path_);
    std::stringstream content;
    content << file.rdbuf();
    all = content.str();
    length[0] = static_cast<int>(path_.size());
    length[1] = static_cast<int>(all.size());
  }
  MPI_Bcast(length, 2, MPI_INT, 0, lmp_->world);
  if (length[0] == 0)
    fail(
        fmt::format("was not found; searched were the folder of the run, those of LAMMPS_POTENTIALS and "
                    "GPUDEM_POTENTIALS and those of the build: {}",
                    fmt::join(folders(), ", ")));
  path_.resize(static_cast<std::size_t>(length[0]));
  all.resize(static_cast<std::size_t>(length[1]));
  MPI_Bcast(&path_[0], length[0], MPI_CHAR, 0, lmp_->world);
  MPI_Bcast(&all[0], length[1], MPI_CHAR, 0, lmp_->world);
  return all;
}

void MaterialFile::checkHeader(const std::string &line) const
{
  const std::vector<std::string> words = utils::split_words(line);
  const std::string units = field(words, "UNITS:"), date = field(words, "DATE:"), inUse = lmp_->update->unit_style;
  if (words.empty() || words[0][0] != '#' || units.empty() || date.empty())
    failLine(
        "must be a comment that tells date and units: # DATE: yyyy-mm-dd UNITS: si CONTRIBUTOR: ... CITATION: ...");
  if (units != inUse)
    failLine(fmt::format("the numbers are in '{}' units (UNITS:), but the script uses units '{}'", units, inUse));
  utils::logmesg(lmp_, "Reading material file {} with DATE: {}\n", path_, date);
}

void MaterialFile::readLine(const std::vector<std::string> &words)
{
  if (words[0] == "material") readMaterial(words);
  else if (words[0] == "pair") readPair(words);
  else if (words[0] == "law") readLaw(words);
  else failLine(fmt::format("unknown word '{}'; a line begins with material, pair, law or #", words[0]));
}

/// Word \p at is the name of a number, the next its value.
template <class Of>
void MaterialFile::readNumber(Of &of, const std::vector<NumberOf<Of>> &numbers, const std::vector<std::string> &words,
                              std::size_t &at, std::vector<bool> &given) const
{
  const std::string &name = words[at];
  given.resize(numbers.size(), false);
  for (std::size_t n = 0; n < numbers.size(); ++n) {
    if (name != numbers[n].info.name) continue;
    if (given[n]) failLine(fmt::format("'{}' is given twice", name));
    given[n] = true;
    if (at + 1 >= words.size()) failLine(fmt::format("the number of '{}' is missing", name));
    const std::string &value = words[at + 1];
    if (!isNumber(value)) failLine(fmt::format("'{}' stands where the number of '{}' is expected", value, name));
    try {
      of.*numbers[n].value = std::strtod(value.c_str(), nullptr);
      gpudem::checkValue(words[0], numbers[n].info, of.*numbers[n].value);
    } catch (const gpudem::Error &e) {
      failLine(e.what());
    }
    at += 2;
    return;
  }
  failLine(fmt::format("unknown word '{}'; '{}' takes {}", name, words[0], listed(numbers)));
}

template <class Of>
void MaterialFile::readNumbers(Of &of, const std::vector<NumberOf<Of>> &numbers, const std::vector<std::string> &words,
                               std::size_t first) const
{
  std::vector<bool> given(numbers.size(), false);
  for (std::size_t at = first; at < words.size();) readNumber(of, numbers, words, at, given);
  for (std::size_t n = 0; n < numbers.size(); ++n)
    if (numbers[n].needed && !given[n])
      failLine(fmt::format("'{}' is missing; '{}' takes {}", numbers[n].info.name, words[0], listed(numbers)));
}

void MaterialFile::readMaterial(const std::vector<std::string> &words)
{
  if (words.size() < 2) failLine("the name of the material is missing");
  const std::string &name = words[1];
  if (name == "NULL") failLine("a material cannot be named NULL, which stands for no material");
  if (materials_.count(name))
    failLine(fmt::format("material '{}' is given twice, first in line {}", name, materials_.at(name).line));
  Material m;
  readNumbers(m, gpudem::materialNumbers(), words, 2);
  materials_[name] = {m, line_};
}

void MaterialFile::readPair(const std::vector<std::string> &words)
{
  if (words.size() < 3) failLine("the names of two materials are missing");
  for (std::size_t k = 1; k < 3; ++k)
    if (!materials_.count(words[k]))
      failLine(fmt::format("unknown material '{}'; above this line stand {}", words[k], known()));
  const Names names = ordered(words[1], words[2]);
  if (pairs_.count(names))
    failLine(fmt::format("pair '{} {}' is given twice, first in line {}", words[1], words[2], pairs_.at(names).line));
  MaterialPair p;
  readNumbers(p, gpudem::pairNumbers(), words, 3);
  pairs_[names] = {p, line_};
}

void MaterialFile::readLaw(const std::vector<std::string> &words)
{
  if (law_.line) failLine(fmt::format("a second law; the first stands in line {}", law_.line));
  law_.line = line_;
  MaterialLaw &law = law_.thing;
  std::vector<bool> given;
  const auto oneOf = [&](ModelSlot slot, const std::string &word) {
    const std::vector<std::string> &all = gpudem::materialNames(slot);
    if (std::find(all.begin(), all.end(), word) == all.end())
      failLine(fmt::format("unknown {} sub-model '{}'; a law made of materials takes {}", gpudem::slotName(slot), word,
                           fmt::join(all, ", ")));
    return word;
  };
  const std::pair<ModelSlot, std::string MaterialLaw::*> slots[] = {{ModelSlot::Tangential, &MaterialLaw::tangential},
                                                                    {ModelSlot::Rolling, &MaterialLaw::rolling},
                                                                    {ModelSlot::Twisting, &MaterialLaw::twisting}};
  const std::vector<std::string> &normals = gpudem::materialNames(ModelSlot::Normal);
  for (std::size_t at = 1; at < words.size();) {
    const std::string &w = words[at];
    const auto *slot =
        std::find_if(std::begin(slots), std::end(slots), [&](const auto &s) { return w == gpudem::slotName(s.first); });
    if (slot != std::end(slots)) {
      if (at + 1 >= words.size()) failLine(fmt::format("the name of the {} sub-model is missing", w));
      law.*slot->second = oneOf(slot->first, words[at + 1]);
      at += 2;
    } else if (w == "limit_damping") {
      law.limitDamping = true;
      ++at;
    } else if (isLawNumber(w)) {
      readNumber(law, gpudem::lawNumbers(), words, at, given);
    } else if (std::find(normals.begin(), normals.end(), w) != normals.end()) {
      law.normal = w;
      ++at;
    } else {
      failLine(
          fmt::format("unknown word '{}'; 'law' takes a normal sub-model ({}), tangential, rolling, twisting, "
                      "limit_damping, {}",
                      w, fmt::join(normals, ", "), listed(gpudem::lawNumbers())));
    }
  }
}

/// Every pair must make a law, also those that this script does not use.
void MaterialFile::checkPairs()
{
  for (const auto &entry : pairs_) {
    line_ = entry.second.line;
    const Material *a = &materials_.at(entry.first.first).thing, *b = &materials_.at(entry.first.second).thing;
    if (!(a->density > 0.0)) std::swap(a, b);  // without density: of a wall
    const auto partner = b->density > 0.0 ? gpudem::Partner::Grain : gpudem::Partner::Wall;
    try {
      gpudem::materialModel(*a, *b, entry.second.thing, law_.thing, partner);
    } catch (const gpudem::Error &e) {
      failLine(e.what());
    }
  }
}

std::string MaterialFile::known() const
{
  std::vector<std::string> names;
  for (const auto &m : materials_) names.push_back(m.first);
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

const Material &MaterialFile::material(const std::string &name) const
{
  const auto found = materials_.find(name);
  if (found == materials_.end()) fail(fmt::format("has no material '{}'; it has {}", name, known()));
  return found->second.thing;
}

gpudem::ContactModel MaterialFile::model(const std::string &a, const std::string &b, gpudem::Partner partner) const
{
  const Material &ma = material(a), &mb = material(b);
  const auto found = pairs_.find(ordered(a, b));
  if (found == pairs_.end())
    fail(
        fmt::format("has materials {} (line {}) and {} (line {}), but not what is measured of the two: add a line "
                    "'pair {} {} restitution E friction MU'",
                    a, materials_.at(a).line, b, materials_.at(b).line, a, b));
  try {
    return gpudem::materialModel(ma, mb, found->second.thing, law_.thing, partner);
  } catch (const gpudem::Error &e) {
    failAt(found->second.line, e.what());
  }
}
