// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Contact laws as products of sub-models: normal x damping x tangential x rolling x twisting x cohesion.
///
/// A sub-model is named as in LAMMPS' pair_style granular (those beyond it as in the literature or in LIGGGHTS) and
/// declares its parameters; a ContactModel names one sub-model per slot. Formulas stand in src/contact/, one header per
/// sub-model.
#pragma once

#include <string>
#include <vector>

namespace gpudem {

enum class ModelSlot { Normal, Damping, Tangential, Rolling, Twisting, Cohesion };
constexpr int modelSlots = 6;

/// "normal", "damping", ...
const char *slotName(ModelSlot slot);

/// One number that a sub-model takes.
struct ParameterInfo {
  const char *name;  ///< symbol in messages and pages
  const char *unit;
  double low, high;  ///< allowed range; an excluded bound is moved by one representable number
  bool derivable;    ///< NULL lets the model derive the value from the elastic constants
};

struct SubModelInfo {
  std::string name;
  std::vector<ParameterInfo> parameters;  ///< in the order of the script
  int history = 0;                        ///< numbers kept per contact
};

/// All sub-models of a slot.
const std::vector<SubModelInfo> &subModels(ModelSlot slot);
/// \throws Error listing the known names
const SubModelInfo &subModel(ModelSlot slot, const std::string &name);

struct SubModel {
  std::string name;
  std::vector<double> parameter;  ///< as many as declared; not-a-number stands for NULL
};

/// Which normal force the limits of friction, rolling and twisting count from where there is a cohesion sub-model.
enum class CoulombBase {
  Contact,  ///< that of the normal sub-model: in a cohesive contact at rest it balances the attraction (LAMMPS)
  Net       ///< the sum of both (LIGGGHTS up to 3.3; later its tangential_reduce decides)
};

/// One contact law. The damping coefficient is the second parameter of the normal sub-model, as in LAMMPS.
struct ContactModel {
  SubModel normal, tangential;
  SubModel damping{"viscoelastic", {}}, rolling{"none", {}}, twisting{"none", {}};
  SubModel cohesion{"none", {}};
  bool limitDamping = false;  ///< clip the normal force at zero: no attraction from the dashpot
  double lever = 0.5;         ///< the torque arm is the radius less this fraction of the overlap (pairs 1/2, walls 0)
  double slipLever = 0.0;     ///< the arm of the slip velocity likewise (LAMMPS 0, LIGGGHTS 1/2)
  CoulombBase coulombBase = CoulombBase::Contact;

  const SubModel &slot(ModelSlot s) const;
  SubModel &slot(ModelSlot s) { return const_cast<SubModel &>(const_cast<const ContactModel *>(this)->slot(s)); }
};

/// \throws Error naming \p label, the parameter and its range
void checkValue(const std::string &label, const ParameterInfo &info, double value);

/// \throws Error naming the sub-model, the parameter and its range
void checkModel(const ContactModel &model);

/// The law between two materials, from their laws with themselves: moduli from both materials (harmonic means of E*
/// and G*), everything else the geometric mean, as documented for LAMMPS' pair_style granular.
/// \throws Error if the two use different sub-models
ContactModel mixModels(const ContactModel &a, const ContactModel &b);

/// Where the numbers of a contact lie: blocks of the slots in the order tangential, rolling, twisting, normal,
/// cohesion.
struct HistoryLayout {
  int size = 0;                     ///< numbers per contact
  int at[modelSlots] = {};          ///< first number of each slot
  int length[modelSlots] = {};      ///< numbers of each slot
  std::vector<signed char> mirror;  ///< [size] sign of each number when the two grains change places
};
/// Layout that serves all of \p models.
/// \throws Error if sub-models of one slot differ in the signs of what they keep (rolling sds and epsd)
HistoryLayout historyLayout(const std::vector<ContactModel> &models);

/// Does the contact outlive touch (adhesion necks, liquid bridges)?
bool reachesBeyondTouch(const ContactModel &model);
/// Do grains that come near pull on each other before they touch? Within the pull-off gap they are in contact then.
bool actsBeforeTouch(const ContactModel &model);
/// Largest gap at which two grains of effective radius \p effectiveRadius still pull on each other (distance).
double pullOffGap(const ContactModel &model, double effectiveRadius);

/// Coefficient of the normal dashpot as the damping sub-model uses it (its restitution turned into alpha, ...).
double dampingCoefficient(const ContactModel &model);

/// Moduli of a law whose normal sub-model names a material.
struct ContactModuli {
  double young = 0;  ///< E* (force/area)
  double shear = 0;  ///< G* (force/area)
  bool known = false;
};
ContactModuli contactModuli(const ContactModel &model);
/// Material (E, nu) that, in contact with itself, has the moduli \p m.
void equivalentMaterial(const ContactModuli &m, double &young, double &poisson);

/// One contact, for tests and for output of single contacts. Units are the caller's.
struct ContactState {
  double branch[3];            ///< from the partner's centre (or the wall) to the grain's (distance)
  double overlap;              ///< (distance)
  double radius;               ///< of the grain, for the torque arm (distance)
  double effectiveRadius;      ///< R_i R_j/(R_i + R_j)
  double effectiveMass;        ///< m_i m_j/(m_i + m_j)
  double relativeVelocity[3];  ///< v_i - v_j
  double surfaceSpin[3];       ///< R_i omega_i + R_j omega_j
  double spinDifference[3];    ///< omega_i - omega_j
  double partnerRadius;        ///< (distance); 0: the partner is a wall
  double inertia;              ///< I_i I_j/(I_i + I_j), I = m R^2; m R^2 at a wall
};
struct ContactResult {
  double force[3], torque[3];  ///< on the grain
  double normal[3];            ///< unit vector from the partner to the grain
  double push;                 ///< normal force, repulsion positive
  double friction[3];          ///< tangential force
  double rolling[3];           ///< rolling torque
  double twisting;             ///< twisting torque along the normal
};
/// Force of \p model at \p state; \p history is read and advanced by \p dt (not advanced if dt is 0).
ContactResult evaluateContact(const ContactModel &model, const HistoryLayout &layout, const ContactState &state,
                              double *history, double dt);
/// As evaluateContact in the forces at the start of a run of time step \p dt: springs do not grow, and dt tells which slide.
ContactResult evaluateContactAtStart(const ContactModel &model, const HistoryLayout &layout, const ContactState &state,
                                     double *history, double dt);

}  // namespace gpudem
