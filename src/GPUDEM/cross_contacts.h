// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#ifndef LMP_GPUDEM_CROSS_CONTACTS_H
#define LMP_GPUDEM_CROSS_CONTACTS_H

#include "lmptype.h"

#include <mpi.h>

#include <vector>

namespace LAMMPS_NS {

/// Contacts between grains of two ranks: what the other rank's grain keeps of the same contact.
class CrossContacts {
 public:
  /// \param numbers kept per contact
  CrossContacts(MPI_Comm world, int numbers);
  /// \p owner is a grain of this rank, \p partner is not.
  void add(tagint owner, tagint partner, const double *kept);
  /// Ask the other ranks. Collective.
  void match();
  /// What the partner of the \p k-th contact added keeps, null if it does not know the contact. After match().
  const double *partnersCopy(std::size_t k) const;

 private:
  MPI_Comm world_;
  std::size_t numbers_, width_;  ///< doubles of what is kept; of a record, which begins with both IDs
  std::vector<double> records_;  ///< [contacts][width]
  std::vector<double> answers_;  ///< [contacts][1 + numbers], the first 1 where there is an answer
};

}  // namespace LAMMPS_NS
#endif
