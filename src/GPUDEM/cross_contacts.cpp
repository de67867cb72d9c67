// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "cross_contacts.h"

#include <algorithm>
#include <map>
#include <utility>

using namespace LAMMPS_NS;

namespace {

/// What each rank gets, from blocks of \p width doubles that lie in the order of the ranks.
/// \param blocks [ranks] sent to each rank; on return those received from each
std::vector<double> deliver(MPI_Comm world, const std::vector<double> &send, std::vector<int> &blocks,
                            std::size_t width)
{
  const int ranks = static_cast<int>(blocks.size()), w = static_cast<int>(width);
  std::vector<int> from(ranks), sendAt(ranks + 1, 0), receiveAt(ranks + 1, 0);
  MPI_Alltoall(blocks.data(), 1, MPI_INT, from.data(), 1, MPI_INT, world);
  std::vector<int> sendLength(ranks), receiveLength(ranks);
  for (int r = 0; r < ranks; ++r) {
    sendLength[r] = w * blocks[r];
    receiveLength[r] = w * from[r];
    sendAt[r + 1] = sendAt[r] + sendLength[r];
    receiveAt[r + 1] = receiveAt[r] + receiveLength[r];
  }
  std::vector<double> received(receiveAt[ranks]);
  MPI_Alltoallv(send.data(), sendLength.data(), sendAt.data(), MPI_DOUBLE, received.data(), receiveLength.data(),
                receiveAt.data(), MPI_DOUBLE, world);
  blocks = from;
  return received;
}

}  // namespace

CrossContacts::CrossContacts(MPI_Comm world, int numbers) : world_(world), numbers_(numbers), width_(numbers_ + 2)
{
}

void CrossContacts::add(tagint owner, tagint partner, const double *kept)
{
  records_.push_back(owner);
  records_.push_back(partner);
  records_.insert(records_.end(), kept, kept + numbers_);
}

void CrossContacts::match()
{
  int ranks;
  MPI_Comm_size(world_, &ranks);
  const std::size_t contacts = records_.size() / width_;

  // both sides of a contact meet on the rank that its smaller ID names
  const auto meeting = [&](const double *r) { return static_cast<tagint>(std::min(r[0], r[1])) % ranks; };
  std::vector<int> blocks(ranks, 0);
  for (std::size_t k = 0; k < contacts; ++k) ++blocks[meeting(&records_[width_ * k])];
  std::vector<std::size_t> next(ranks + 1, 0), place(contacts);
  for (int r = 0; r < ranks; ++r) next[r + 1] = next[r] + blocks[r];
  std::vector<double> sorted(records_.size());
  for (std::size_t k = 0; k < contacts; ++k) {
    place[k] = next[meeting(&records_[width_ * k])]++;
    std::copy_n(&records_[width_ * k], width_, sorted.begin() + width_ * place[k]);
  }
  const std::vector<double> met = deliver(world_, sorted, blocks, width_);

  const std::size_t size = met.size() / width_, answer = numbers_ + 1;
  std::map<std::pair<double, double>, const double *> known;
  for (std::size_t k = 0; k < size; ++k) known[{met[width_ * k], met[width_ * k + 1]}] = &met[width_ * k + 2];
  std::vector<double> replies(answer * size, 0.0);
  for (std::size_t k = 0; k < size; ++k) {
    const auto other = known.find({met[width_ * k + 1], met[width_ * k]});
    if (other == known.end()) continue;
    replies[answer * k] = 1.0;
    std::copy_n(other->second, numbers_, replies.begin() + answer * k + 1);
  }
  const std::vector<double> back = deliver(world_, replies, blocks, answer);
  answers_.resize(answer * contacts);
  for (std::size_t k = 0; k < contacts; ++k)
    std::copy_n(back.begin() + answer * place[k], answer, answers_.begin() + answer * k);
}

const double *CrossContacts::partnersCopy(std::size_t k) const
{
  const double *answer = answers_.data() + (numbers_ + 1) * k;
  return answer[0] > 0.0 ? answer + 1 : nullptr;
}
