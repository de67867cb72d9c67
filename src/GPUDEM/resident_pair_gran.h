// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file What the three gran/ pair styles share: the stock style plus its description for the device.
#ifndef LMP_RESIDENT_PAIR_GRAN_H
#define LMP_RESIDENT_PAIR_GRAN_H

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix_neigh_history.h"
#include "force.h"
#include "modify.h"
#include "pair_gran_hooke_history.h"
#include "resident.h"
#include "resident_names.h"

#include <algorithm>

namespace LAMMPS_NS {

/// Stock settings(), coeff(), restart format, single() and host compute(); the device reads the protected members.
template <class Stock, gpudem::NormalModel normalModel, bool springs>
class PairGranResident : public Stock, public ResidentPair {
 public:
  explicit PairGranResident(LAMMPS *lmp) : Stock(lmp)
  {
    this->limit_damping = 0;  // not in a restart file; the stock style leaves it unset after reading one
  }

  void init_style() { initStyle(); }

  void describeLaws(gpudem::SceneSpec &scene) const override
  {
    gpudem::ContactLaw &law = scene.pair;
    law.normal = normalModel;
    law.tangential = springs                                   ? gpudem::TangentialModel::Spring
                     : this->gammat == 0.0 || this->xmu == 0.0 ? gpudem::TangentialModel::None
                                                               : gpudem::TangentialModel::Viscous;
    law.normalStiffness = this->kn;
    law.tangentialStiffness = this->kt;
    law.normalDamping = this->gamman;
    law.tangentialDamping = this->gammat;
    law.friction = this->xmu;
    law.limitDamping = this->limit_damping != 0;
  }
  unsigned frozenMask() const override { return static_cast<unsigned>(this->freeze_group_bit); }
  double largestRadius() const override
  {
    double r = 0.0;
    for (int t = 1; t <= this->atom->ntypes; ++t) r = std::max({r, this->maxrad_dynamic[t], this->maxrad_frozen[t]});
    return r;
  }
  void setVirial(const std::array<double, 6> &virial) override
  {
    this->eng_vdwl = this->eng_coul = 0.0;
    std::copy(virial.begin(), virial.end(), this->virial);
  }

 protected:
  /// Stock init_style(), after making sure that its history fix is ours and that ghosts carry velocities.
  void initStyle()
  {
    giveBackStockName(this->lmp, this);
    if (this->comm->ghost_velocity == 0) {
      if (this->comm->me == 0)
        this->error->warning(FLERR, "Granular pair styles need 'comm_modify vel yes'; GPUDEM turned it on");
      this->comm->ghost_velocity = 1;
    }
    if (springs && this->fix_history == nullptr) {
      const std::string number = std::to_string(this->instance_me);
      this->fix_history = (FixNeighHistory *)this->modify->replace_fix(
          "NEIGH_HISTORY_HH_DUMMY" + number, "NEIGH_HISTORY_HH" + number + " all NEIGH_HISTORY/gpudem 3", 0);
      this->fix_history->pair = this;
    }
    PairGranHookeHistory::init_style();
  }
};

}  // namespace LAMMPS_NS
#endif
