// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "granular_model.h"

#include "gpudem_settings.h"

#include "error.h"
#include "gpudem/errors.h"
#include "lammps.h"
#include "utils.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

using namespace LAMMPS_NS;
using gpudem::ContactModel;
using gpudem::ModelSlot;

namespace {

// LAMMPS' enumerations, which are local to pair_granular.cpp
const std::array<const char *, 5> stockNormal{"hooke", "hertz", "hertz/material", "dmt", "jkr"};
const std::array<const char *, 4> stockDamping{"velocity", "mass_velocity", "viscoelastic", "tsuji"};
const std::array<const char *, 6> stockTangential{"linear_nohistory", "linear_history", "mindlin",
                                                  "mindlin_rescale",  "mindlin/force",  "mindlin_rescale/force"};
const std::array<const char *, 2> stockRolling{"none", "sds"};
const std::array<const char *, 3> stockTwisting{"none", "sds", "marshall"};

template <std::size_t n>
int indexOf(const std::array<const char *, n> &names, const std::string &name)
{
  for (std::size_t k = 0; k < n; ++k)
    if (name == names[k]) return static_cast<int>(k);
  return -1;
}

/// Reads words one by one and says what is missing.
class WordReader {
 public:
  WordReader(LAMMPS *lmp, const std::string &command, int narg, char **arg, int first)
      : lmp_(lmp), command_(command), narg_(narg), arg_(arg), at_(first)
  {
  }
  int at() const { return at_; }
  bool done() const { return at_ >= narg_; }
  std::string peek() const { return arg_[at_]; }
  std::string word(const std::string &what)
  {
    if (done()) lmp_->error->all(FLERR, "{}: {} is missing at the end of the command", command_, what);
    return arg_[at_++];
  }
  /// The parameters of one sub-model.
  std::vector<double> parameters(const std::string &label, const std::vector<gpudem::ParameterInfo> &infos)
  {
    std::vector<double> values;
    for (const gpudem::ParameterInfo &info : infos) {
      const std::string w = word(fmt::format("{} of {} (it takes {})", info.name, label, listed(infos)));
      if (w == "NULL" && info.derivable) values.push_back(std::numeric_limits<double>::quiet_NaN());
      else if (w == "NULL") lmp_->error->all(FLERR, "{}: {} of {} cannot be NULL", command_, info.name, label);
      else if (!isNumber(w))
        lmp_->error->all(FLERR, "{}: '{}' stands where {} of {} is expected, a number (it takes {})", command_, w,
                         info.name, label, listed(infos));
      else values.push_back(std::stod(w));
    }
    return values;
  }
  double number(const std::string &what)
  {
    const std::string w = word(what);
    if (!isNumber(w)) lmp_->error->all(FLERR, "{}: '{}' stands where {} is expected, a number", command_, w, what);
    return std::stod(w);
  }

  /// A choice of two words: is it the second?
  bool second(const std::string &keyword, const std::string &one, const std::string &other)
  {
    const std::string w = word(fmt::format("{} or {} of {}", one, other, keyword));
    if (w != one && w != other)
      lmp_->error->all(FLERR, "{}: {} is {} or {}, not '{}'", command_, keyword, one, other, w);
    return w == other;
  }

 private:
  static bool isNumber(const std::string &w)
  {
    char *end = nullptr;
    std::strtod(w.c_str(), &end);
    return !w.empty() && *end == '\0';
  }
  static std::string listed(const std::vector<gpudem::ParameterInfo> &infos)
  {
    std::string all;
    for (const gpudem::ParameterInfo &info : infos) all += (all.empty() ? "" : " ") + std::string(info.name);
    return all;
  }
  LAMMPS *lmp_;
  std::string command_;
  int narg_;
  char **arg_;
  int at_;
};

bool isModel(ModelSlot slot, const std::string &name)
{
  const auto &all = gpudem::subModels(slot);
  return std::any_of(all.begin(), all.end(), [&](const gpudem::SubModelInfo &m) { return m.name == name; });
}

/// Stiffness as the tangential sub-model uses it: the given number or the material's.
double tangentialStiffness(const ContactModel &model)
{
  const double kt = model.tangential.parameter[0];
  return std::isnan(kt) ? 8.0 * gpudem::contactModuli(model).shear : kt;
}

std::string text(double value)
{
  return fmt::format("{:.17g}", value);
}

}  // namespace

int LAMMPS_NS::readGranularWords(LAMMPS *lmp, const std::string &command, int narg, char **arg, int first,
                                 const std::vector<std::string> &stop, GranularWords &words)
{
  WordReader reader(lmp, command, narg, arg, first);
  ContactModel &model = words.model;
  bool normal = false, tangential = false;
  try {
    while (!reader.done()) {
      const std::string w = reader.peek();
      if (std::find(stop.begin(), stop.end(), w) != stop.end()) break;
      reader.word("a word");
      const auto read = [&](ModelSlot slot, const std::string &name) {
        const gpudem::SubModelInfo &info = gpudem::subModel(slot, name);
        model.slot(slot).name = name;
        if (slot == ModelSlot::Damping) return;  // its number stands with the normal sub-model
        model.slot(slot).parameter =
            reader.parameters(fmt::format("{} {}", gpudem::slotName(slot), name), info.parameters);
      };
      if (isModel(ModelSlot::Normal, w)) {
        read(ModelSlot::Normal, w);
        normal = true;
        continue;
      }
      bool slotWord = false;
      for (int s = 1; s < gpudem::modelSlots; ++s) {
        const auto slot = static_cast<ModelSlot>(s);
        if (w != gpudem::slotName(slot)) continue;
        read(slot, reader.word(fmt::format("the name of the {} sub-model", w)));
        tangential = tangential || slot == ModelSlot::Tangential;
        slotWord = true;
      }
      if (slotWord) continue;
      if (w == "cutoff") words.cutoff = reader.number("the distance of cutoff");
      else if (w == "limit_damping") model.limitDamping = true;
      else if (w == "arm") model.slipLever = reader.second(w, "lammps", "contact_point") ? 0.5 : 0.0;
      else if (w == "coulomb")
        model.coulombBase =
            reader.second(w, "contact", "net") ? gpudem::CoulombBase::Net : gpudem::CoulombBase::Contact;
      else if (w == "heat" && !reader.done() && reader.peek() == "none") reader.word("none");
      else if (w == "heat" || w == "synchronized_verlet")
        lmp->error->all(FLERR, "{}: keyword '{}' is not available", command, w);
      else {
        std::vector<std::string> names;
        for (const auto &m : gpudem::subModels(ModelSlot::Normal)) names.push_back(m.name);
        lmp->error->all(FLERR,
                        "{}: unknown word '{}'; known are the normal sub-models {}, and the keywords damping, "
                        "tangential, rolling, twisting, cohesion, arm, coulomb, cutoff, limit_damping (a material file is "
                        "named *.gran)",
                        command, w, fmt::join(names, ", "));
      }
    }
    if (!normal)
      lmp->error->all(FLERR, "{}: a normal sub-model (hooke, hertz, hertz/material, ...) is missing", command);
    if (!tangential) lmp->error->all(FLERR, "{}: keyword 'tangential' with its sub-model is missing", command);
    if (model.damping.name == "tsuji" && gpudemSettings(lmp).conventions == "lammps")
      model.damping.name = "tsuji/lammps";
    gpudem::checkModel(model);
    gpudem::dampingCoefficient(model);  // derives everything: NULL without a material is found here
  } catch (const gpudem::Error &e) {
    lmp->error->all(FLERR, "{}: {}", command, e.what());
  }
  return reader.at();
}

std::string LAMMPS_NS::granularWords(const ContactModel &model)
{
  const auto words = [](const gpudem::SubModel &sub) {
    std::string all = sub.name;
    for (const double x : sub.parameter) all += std::isnan(x) ? " NULL" : fmt::format(" {}", x);
    return all;
  };
  std::string all =
      fmt::format("{} damping {} tangential {}", words(model.normal), model.damping.name, words(model.tangential));
  if (model.rolling.name != "none") all += " rolling " + words(model.rolling);
  if (model.twisting.name != "none") all += " twisting " + words(model.twisting);
  if (model.limitDamping) all += " limit_damping";
  return all;
}

StockNumbers LAMMPS_NS::stockNumbers(const ContactModel &model)
{
  StockNumbers n;
  n.normal = indexOf(stockNormal, model.normal.name);
  const bool restitution = model.damping.name == "coeff_restitution" || model.damping.name == "tsuji/lammps";
  n.damping = indexOf(stockDamping, restitution ? "tsuji" : model.damping.name);
  n.tangential = indexOf(stockTangential, model.tangential.name == "none" ? "linear_nohistory" : model.tangential.name);
  n.rolling = indexOf(stockRolling, model.rolling.name);
  n.twisting = indexOf(stockTwisting, model.twisting.name);
  const bool stock = model.cohesion.name == "none" && model.slipLever == 0.0;
  n.known = stock && n.normal >= 0 && n.damping >= 0 && n.tangential >= 0 && n.rolling >= 0 && n.twisting >= 0;
  return n;
}

ContactModel LAMMPS_NS::modelOfNumbers(const StockNumbers &n)
{
  ContactModel m;
  m.normal.name = stockNormal.at(static_cast<std::size_t>(n.normal));
  m.damping.name = stockDamping.at(static_cast<std::size_t>(n.damping));
  m.tangential.name = stockTangential.at(static_cast<std::size_t>(n.tangential));
  m.rolling.name = stockRolling.at(static_cast<std::size_t>(n.rolling));
  m.twisting.name = stockTwisting.at(static_cast<std::size_t>(n.twisting));
  return m;
}

double LAMMPS_NS::stockTsujiArgument(double alpha)
{
  const auto fit = [](double e) {
    return 1.2728 + e * (-4.2783 + e * (11.087 + e * (-22.348 + e * (27.467 + e * (-18.022 + e * 4.8218)))));
  };
  // the fit falls from far above any coefficient at -1 to its least value near 1
  double low = -1.0, high = 1.01;  // the fit is 3e-4 at 1, and 0 a little later
  for (int k = 0; k < 200; ++k) {
    const double middle = 0.5 * (low + high);
    (fit(middle) > alpha ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double LAMMPS_NS::restitutionOfCoefficient(double alpha, bool linear)
{
  const double beta = alpha / (linear ? 2.0 : std::sqrt(5.0));
  return beta < 1.0 ? std::exp(-3.14159265358979323846 * beta / std::sqrt(1.0 - beta * beta)) : 0.0;
}

std::vector<std::string> LAMMPS_NS::stockWallWords(const ContactModel &model)
{
  const StockNumbers n = stockNumbers(model);
  if (!n.known) return {"hooke", "0", "0", "tangential", "linear_nohistory", "0", "0"};
  std::vector<std::string> w{model.normal.name};
  std::vector<double> p = model.normal.parameter;
  const gpudem::ContactModuli moduli = gpudem::contactModuli(model);
  if (moduli.known) p[0] = moduli.young * 2.0 * (1.0 - p[2]);  // LAMMPS takes E* = E/(2 (1 - nu))
  if (stockDamping[static_cast<std::size_t>(n.damping)] == std::string("tsuji"))
    p[1] = stockTsujiArgument(gpudem::dampingCoefficient(model));
  for (const double x : p) w.push_back(text(x));
  w.insert(w.end(), {"damping", stockDamping[static_cast<std::size_t>(n.damping)]});
  w.insert(w.end(), {"tangential", stockTangential[static_cast<std::size_t>(n.tangential)]});
  if (model.tangential.name == "none") w.insert(w.end(), {"0", "0"});
  for (std::size_t k = 0; k < model.tangential.parameter.size(); ++k)
    w.push_back(text(k == 0 && n.tangential > 0 ? tangentialStiffness(model) : model.tangential.parameter[k]));
  w.insert(w.end(), {"rolling", model.rolling.name});
  for (const double x : model.rolling.parameter) w.push_back(text(x));
  w.insert(w.end(), {"twisting", model.twisting.name});
  for (const double x : model.twisting.parameter) w.push_back(text(x));
  if (model.limitDamping) w.emplace_back("limit_damping");
  return w;
}

ContactModel LAMMPS_NS::stockWallModel(const ContactModel &model)
{
  ContactModel m = model;
  if (!gpudem::contactModuli(model).known) return m;
  const double young = model.normal.parameter[0], nu = model.normal.parameter[2];
  m.normal.parameter[0] = young / (2.0 * (1.0 - nu)) * 2.0 * (1.0 - nu * nu);
  std::vector<double> &t = m.tangential.parameter;
  if (!t.empty() && std::isnan(t[0])) t[0] = young / 4.0 * (2.0 - nu) * (1.0 + nu);
  return m;
}
