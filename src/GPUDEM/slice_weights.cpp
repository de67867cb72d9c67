// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "slice_weights.h"

#include "atom.h"
#include "error.h"
#include "force.h"
#include "group.h"
#include "imbalance_group.h"
#include "imbalance_neigh.h"
#include "imbalance_store.h"
#include "imbalance_time.h"
#include "input.h"
#include "neigh_list.h"
#include "pair.h"
#include "variable.h"

#include <algorithm>

using namespace LAMMPS_NS;

namespace {

constexpr const char *styles = "count, contact, group, neigh, time, var, store";

/// The words after "weight", read one by one.
class Words : protected Pointers {
 public:
  Words(LAMMPS *lmp, const std::string &who, int narg, char **arg) : Pointers(lmp), who_(who), narg_(narg), arg_(arg) {}

  const char *next(const char *what)
  {
    if (used_ >= narg_) error->all(FLERR, "{}: weight{} ends where {} should follow", who_, soFar(), what);
    return arg_[used_++];
  }
  double positive(const char *what)
  {
    const char *word = next(what);
    const double value = utils::numeric(FLERR, word, false, lmp);
    if (!(value > 0.0)) error->all(FLERR, "{}: weight{}: {} must be above 0", who_, soFar(), what);
    return value;
  }
  int used() const { return used_; }
  std::string soFar() const
  {
    std::string text;
    for (int k = 0; k < used_; ++k) text += std::string(" ") + arg_[k];
    return text;
  }

 private:
  const std::string &who_;
  int narg_, used_ = 0;
  char **arg_;
};

/// As LAMMPS' ImbalanceVar, but leaves it to the balancer to say which atom has a wrong weight.
class VariableWeight : public Imbalance {
 public:
  VariableWeight(LAMMPS *lmp, const std::string &name) : Imbalance(lmp), name_(name) {}
  int options(int, char **) override { return 1; }
  void compute(double *weight) override
  {
    const int index = input->variable->find(name_.c_str());  // it may have been defined anew
    if (index < 0) error->all(FLERR, "Weight var: variable '{}' has been deleted", name_);
    std::vector<double> values(std::max(atom->nlocal, 1));
    input->variable->compute_atom(index, group->find("all"), values.data(), 1, 0);
    for (int i = 0; i < atom->nlocal; ++i) weight[i] *= values[i];
  }
  std::string info() override { return fmt::format("  weight variable: {}\n", name_); }

 private:
  std::string name_;
};

}  // namespace

SliceWeight LAMMPS_NS::makeSliceWeight(LAMMPS *lmp, const std::string &who, int narg, char **arg, int &used)
{
  Words words(lmp, who, narg, arg);
  SliceWeight weight;
  weight.style = words.next("a style");
  if (weight.style == "count") {
  } else if (weight.style == "contact") {
    if (!lmp->atom->radius_flag)
      lmp->error->all(FLERR, "{}: weight contact needs grains with a radius, such as atom_style sphere", who);
    weight.imbalance = std::make_unique<ContactWeight>(lmp, words.positive("the weight of a contact"));
  } else if (weight.style == "time" || weight.style == "neigh") {
    words.positive("the factor");
    if (weight.style == "time") weight.imbalance = std::make_unique<ImbalanceTime>(lmp);
    else weight.imbalance = std::make_unique<ImbalanceNeigh>(lmp);
  } else if (weight.style == "group") {
    const int groups = utils::inumeric(FLERR, words.next("the number of groups"), false, lmp);
    if (groups < 1) lmp->error->all(FLERR, "{}: weight group {}: at least one group is needed", who, groups);
    for (int g = 0; g < groups; ++g) {
      const char *name = words.next("a group-ID");
      if (lmp->group->find(name) < 0) lmp->error->all(FLERR, "{}: weight group: there is no group '{}'", who, name);
      words.positive("the weight of the group");
    }
    weight.imbalance = std::make_unique<ImbalanceGroup>(lmp);
  } else if (weight.style == "var") {
    weight.name = words.next("the name of a variable");
    const int index = lmp->input->variable->find(weight.name.c_str());
    if (index < 0) lmp->error->all(FLERR, "{}: weight var: there is no variable '{}'", who, weight.name);
    if (!lmp->input->variable->atomstyle(index))
      lmp->error->all(FLERR, "{}: weight var: variable '{}' must be of style atom or atomfile", who, weight.name);
    weight.imbalance = std::make_unique<VariableWeight>(lmp, weight.name);
  } else if (weight.style == "store") {
    weight.name = words.next("the name of a per-atom vector");
    weight.imbalance = std::make_unique<ImbalanceStore>(lmp);
  } else {
    lmp->error->all(FLERR, "{}: unknown weight '{}'; weights are {}", who, weight.style, styles);
  }
  used = words.used();
  if (weight.imbalance) weight.imbalance->options(used - 1, arg + 1);
  return weight;
}

void ContactWeight::compute(double *weight)
{
  const NeighList *list = force->pair ? force->pair->list : nullptr;
  if (!listIsCurrent_ || !list || !list->ilist) return;
  const int nlocal = atom->nlocal, reach = atom->nlocal + atom->nghost;
  contacts_.assign(nlocal, 0);
  for (int k = 0; k < list->inum; ++k) {
    const int i = list->ilist[k];
    if (i >= nlocal) continue;
    const double *x = atom->x[i], r = atom->radius[i];
    for (int n = 0; n < list->numneigh[i]; ++n) {
      const int j = list->firstneigh[i][n] & NEIGHMASK;
      // a fix that inserts grains drops the ghosts, which the list still names
      if (j >= reach) continue;
      const double *y = atom->x[j], touch = r + atom->radius[j];
      const double dx = x[0] - y[0], dy = x[1] - y[1], dz = x[2] - y[2];
      if (dx * dx + dy * dy + dz * dz >= touch * touch) continue;
      ++contacts_[i];
      if (j < nlocal) ++contacts_[j];
    }
  }
  for (int i = 0; i < nlocal; ++i) weight[i] *= 1.0 + factor_ * contacts_[i];
}

std::string ContactWeight::info()
{
  return fmt::format("  weight of a contact: {}\n", factor_);
}
