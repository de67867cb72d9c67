// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file What fix wall/gran and fix wall/gran/region have in common on the device.
#ifndef LMP_GPUDEM_RESIDENT_WALL_GRAN_H
#define LMP_GPUDEM_RESIDENT_WALL_GRAN_H

#include "resident_wall.h"
#include "wall_arguments.h"

#include "atom.h"
#include "error.h"

#include <algorithm>
#include <string>
#include <vector>

namespace LAMMPS_NS {

/// \tparam Stock FixWallGran or a class that derives from it
template <class Stock>
class ResidentWallGran : protected WallArguments, public Stock, public ResidentWall {
 public:
  ResidentWallGran(LAMMPS *lmp, int narg, char **arg)
      : WallArguments(lmp, narg, arg), Stock(lmp, WallArguments::count(), WallArguments::words()), word(arg[2])
  {
    forceTerm = true;
    if (model) damping = this->normal_coeffs[1];
  }
  void post_constructor() override { keepStockName(this, word.c_str()); }
  void init() override
  {
    // the stock style would apply its fit of damping tsuji again at every run
    if (model) this->normal_coeffs[1] = damping;
    Stock::init();
  }
  void post_force(int vflag) override
  {
    if (onDevice) return;
    if (!stockKnows)
      this->error->all(FLERR,
                       "Fix {}: a sub-model that LAMMPS does not have is in use, but this run is not resident (the log "
                       "says why); only the resident loop evaluates it",
                       word);
    Stock::post_force(vflag);
  }

  bool recordsContacts() const override { return this->peratom_flag != 0; }
  void importContacts(const std::vector<double> &columns) override
  {
    for (int i = 0; i < this->atom->nlocal; ++i)
      std::copy_n(columns.begin() + 8 * static_cast<std::size_t>(i), 8, this->array_atom[i]);
  }

 protected:
  /// Numbers of one contact that differ from what the stock style counted: a sub-model that LAMMPS does not have.
  bool keepsOtherNumbers()
  {
    if (!model) return false;
    gpudem::WallSpec spec;
    spec.model = model;
    const int kept = gpudem::wallHistorySize(spec);
    if (kept == this->size_history) return false;
    this->size_history = kept;
    return true;
  }
  /// Law, group and output of the wall.
  void describeCommon(gpudem::WallSpec &w) const
  {
    w.model = model;
    if (!model) describeLaw(w.law);
    w.groupMask = static_cast<unsigned>(this->groupbit);
    w.recordContacts = recordsContacts();
  }
  /// Append the wall and the term in which it acts.
  void append(gpudem::SceneSpec &scene, const gpudem::WallSpec &w)
  {
    wall = static_cast<int>(scene.walls.size());
    scene.walls.push_back(w);
    gpudem::ForceTerm t;
    t.kind = w.shape == gpudem::WallShape::Region ? gpudem::ForceTermKind::RegionWall : gpudem::ForceTermKind::Wall;
    t.groupMask = w.groupMask;
    t.wall = wall;
    term = static_cast<int>(scene.terms.size());
    scene.terms.push_back(t);
  }

  std::string word;      ///< style as the script spells it
  double damping = 0.0;  ///< coefficient as the constructor read it

 private:
  void describeLaw(gpudem::ContactLaw &law) const
  {
    law.normal = this->pairstyle == Stock::HERTZ_HISTORY ? gpudem::NormalModel::Hertz : gpudem::NormalModel::Hooke;
    law.tangential =
        this->pairstyle == Stock::HOOKE ? gpudem::TangentialModel::Viscous : gpudem::TangentialModel::Spring;
    law.normalStiffness = this->kn;
    law.tangentialStiffness = this->kt;
    law.normalDamping = this->gamman;
    law.tangentialDamping = this->gammat;
    law.friction = this->xmu;
    law.limitDamping = this->limit_damping != 0;
  }
};

}  // namespace LAMMPS_NS
#endif
