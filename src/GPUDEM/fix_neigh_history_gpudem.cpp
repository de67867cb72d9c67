// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "fix_neigh_history_gpudem.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "my_page.h"
#include "utils.h"
#include "verlet_gpudem.h"

#include <algorithm>

using namespace LAMMPS_NS;

void FixNeighHistoryGpudem::post_constructor()
{
  delete[] style;
  style = utils::strdup("NEIGH_HISTORY");
}

void FixNeighHistoryGpudem::pre_exchange()
{
  if (!resident) FixNeighHistory::pre_exchange();
}

void FixNeighHistoryGpudem::post_neighbor()
{
  if (synchroniser) return;
  FixNeighHistory::post_neighbor();
  resident = false;
}

void FixNeighHistoryGpudem::write_restart(FILE *fp)
{
  if (synchroniser) synchroniser->downloadContacts();
  FixNeighHistory::write_restart(fp);
}

void FixNeighHistoryGpudem::exportTo(gpudem::ContactHistory &history) const
{
  const int nlocal = atom->nlocal;
  history.offset.assign(nlocal + 1, 0);
  for (int i = 0; i < nlocal; ++i) history.offset[i + 1] = history.offset[i] + static_cast<unsigned>(npartner[i]);
  history.partner.clear();
  history.spring.clear();
  history.partner.reserve(history.offset[nlocal]);
  history.spring.reserve(3 * static_cast<std::size_t>(history.offset[nlocal]));
  for (int i = 0; i < nlocal; ++i) {
    history.partner.insert(history.partner.end(), partner[i], partner[i] + npartner[i]);
    history.spring.insert(history.spring.end(), valuepartner[i], valuepartner[i] + 3 * npartner[i]);
  }
}

void FixNeighHistoryGpudem::importFrom(const gpudem::ContactHistory &history)
{
  if (!ipage_atom) allocate_pages();
  ipage_atom->reset();
  dpage_atom->reset();
  const int nlocal = static_cast<int>(history.offset.size()) - 1;
  maxpartner = 0;
  for (int i = 0; i < nlocal; ++i) {
    const std::size_t first = history.offset[i];
    const int n = static_cast<int>(history.offset[i + 1] - history.offset[i]);
    npartner[i] = n;
    partner[i] = ipage_atom->get(n);
    valuepartner[i] = dpage_atom->get(dnum * n);
    if (!partner[i] || !valuepartner[i])
      error->one(FLERR, "Atom {} has {} contacts: raise 'neigh_modify one' above that", atom->tag[i], n);
    std::copy_n(history.partner.data() + first, n, partner[i]);
    std::copy_n(history.spring.data() + 3 * first, 3 * n, valuepartner[i]);
    maxpartner = std::max(maxpartner, n);
  }
  maxexchange = (dnum + 1) * maxpartner + 1;
}
