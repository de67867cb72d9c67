// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "fix_neigh_history_gpudem.h"

#include "cross_contacts.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "my_page.h"
#include "utils.h"
#include "verlet_gpudem.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;

void FixNeighHistoryGpudem::post_constructor()
{
  delete[] style;
  style = utils::strdup("NEIGH_HISTORY");
}

void FixNeighHistoryGpudem::setPlaces(const std::vector<int> &places, const std::vector<signed char> &signs)
{
  if (!places.empty() && *std::max_element(places.begin(), places.end()) >= dnum)
    error->all(FLERR, "The contact laws keep more numbers than when contact history was created; use a new pair_style");
  place = places;
  mirror = signs;
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

/// Where grain \p i holds its contact with \p wanted, -1 if it holds none. A body that touches thousands is asked by all
/// of them: its list is sorted once.
int FixNeighHistoryGpudem::entryOf(int i, tagint wanted, LongLists &lists) const
{
  constexpr int longestUnsorted = 64;
  const tagint *const begin = partner[i], *const end = begin + npartner[i];
  if (npartner[i] <= longestUnsorted) {
    const tagint *found = std::find(begin, end, wanted);
    return found == end ? -1 : static_cast<int>(found - begin);
  }
  auto &list = lists[i];
  if (list.empty()) {
    for (const tagint *p = begin; p != end; ++p) list.emplace_back(*p, static_cast<int>(p - begin));
    std::sort(list.begin(), list.end());
  }
  const auto found = std::lower_bound(list.begin(), list.end(), std::make_pair(wanted, 0));
  return found != list.end() && found->first == wanted ? found->second : -1;
}

/// What the local atom \p other keeps of its contact with the local atom \p owner, or null.
const double *FixNeighHistoryGpudem::localCopy(int owner, int other, LongLists &lists) const
{
  const int k = entryOf(other, atom->tag[owner], lists);
  return k < 0 ? nullptr : valuepartner[other] + dnum * k;
}

/// delete_atoms renumbers atoms but not the partners stored here, so that an entry may name the wrong grain, with which
/// there is another contact or none.
bool FixNeighHistoryGpudem::isSameContact(const double *mine, const double *theirs) const
{
  if (!theirs) return false;
  double sum = 0.0, size = 0.0;
  for (std::size_t d = 0; d < place.size(); ++d) {
    if (mirror[d] > 0) continue;  // stock LAMMPS keeps rolling and twisting numbers with the wrong sign
    sum += std::fabs(mine[place[d]] + theirs[place[d]]);
    size += std::fabs(mine[place[d]]) + std::fabs(theirs[place[d]]);
  }
  constexpr double roundOff = 1.0e-3;  // of single precision sums; the spring of another contact differs by its size
  return sum <= roundOff * size;
}

void FixNeighHistoryGpudem::exportTo(gpudem::ContactHistory &history, Source source) const
{
  const int nlocal = atom->nlocal;
  const tagint *tag = atom->tag;
  const tagint largest = nlocal ? *std::max_element(tag, tag + nlocal) : 0;
  std::vector<int> localOf(static_cast<std::size_t>(largest) + 1, -1);
  for (int i = 0; i < nlocal; ++i) localOf[tag[i]] = i;
  const auto local = [&](tagint wanted) {
    return wanted < 0 || wanted >= static_cast<tagint>(localOf.size()) ? -1 : localOf[wanted];
  };
  const bool several = comm->nprocs > 1, ask = several && source == Source::Elsewhere;
  CrossContacts cross(world, dnum);
  for (int i = 0; ask && i < nlocal; ++i)
    for (int m = 0; m < npartner[i]; ++m)
      if (local(partner[i][m]) < 0) cross.add(tag[i], partner[i][m], valuepartner[i] + dnum * m);
  if (ask) cross.match();

  history.size = static_cast<int>(place.size());
  history.offset.assign(nlocal + 1, 0);
  history.partner.clear();
  history.spring.clear();
  LongLists lists;
  std::size_t asked = 0;
  for (int i = 0; i < nlocal; ++i) {
    for (int m = 0; m < npartner[i]; ++m) {
      const int other = local(partner[i][m]);
      const double *mine = valuepartner[i] + dnum * m, *theirs = nullptr;
      if (other >= 0) theirs = localCopy(i, other, lists);
      else if (ask) theirs = cross.partnersCopy(asked++);
      const bool kept = other < 0 && several && !ask;  // by the device, which has the same numbers on both sides
      if (!kept && !isSameContact(mine, theirs)) continue;
      history.partner.push_back(partner[i][m]);
      // numbers that both see alike: stock LAMMPS gives the two copies opposite signs, so one grain must decide
      const double *shared = kept || tag[i] < partner[i][m] ? mine : theirs;
      for (std::size_t d = 0; d < place.size(); ++d)
        history.spring.push_back(mirror[d] > 0 ? shared[place[d]] : mine[place[d]]);
    }
    history.offset[i + 1] = static_cast<std::uint32_t>(history.partner.size());
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
    std::fill_n(valuepartner[i], dnum * n, 0.0);
    for (int m = 0; m < n; ++m)
      for (std::size_t d = 0; d < place.size(); ++d)
        valuepartner[i][dnum * m + place[d]] = history.spring[place.size() * (first + m) + d];
    maxpartner = std::max(maxpartner, n);
  }
  maxexchange = (dnum + 1) * maxpartner + 1;
}
