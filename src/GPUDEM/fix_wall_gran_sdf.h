// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#ifndef LMP_FIX_WALL_GRAN_SDF_H
#define LMP_FIX_WALL_GRAN_SDF_H

#include "fix.h"
#include "gpudem/surface_wall.h"
#include "resident_wall.h"
#include "surface_arguments.h"

namespace LAMMPS_NS {

/// fix wall/gran/sdf: a wall made of the triangles of a file. It has no stock counterpart: on the host, too, the
/// library evaluates it.
class FixWallGranSdf : public Fix, public ResidentWall {
 public:
  FixWallGranSdf(class LAMMPS *lmp, int narg, char **arg);
  ~FixWallGranSdf() override;
  int setmask() override;
  void init() override;
  void setup(int vflag) override;
  void post_force(int vflag) override;
  double compute_vector(int n) override;
  double compute_array(int zone, int n) override;

  void grow_arrays(int nmax) override;
  void copy_arrays(int i, int j, int delflag) override;
  void set_arrays(int i) override;
  int pack_exchange(int i, double *buffer) override;
  int unpack_exchange(int nlocal, double *buffer) override;
  int pack_restart(int i, double *buffer) override;
  void unpack_restart(int nlocal, int nth) override;
  int maxsize_restart() override;
  int size_restart(int nlocal) override;
  void write_restart(FILE *file) override;
  void restart(char *buffer) override;
  double memory_usage() override;

  ResidentVerdict resident() override;
  void describe(gpudem::SceneSpec &scene) override;
  bool isRegion() const override { return true; }
  int numbers() const override { return gpudem::wallHistorySize(in.wall); }
  void exportHistory(std::vector<double> &history) override;
  void importHistory(const std::vector<double> &history) override;
  bool recordsContacts() const override { return in.recordContacts; }
  void importContacts(const std::vector<double> &columns) override;
  bool bodyMoves() const override { return !in.moves.empty() || in.servo; }
  std::vector<int> periods() const override;
  gpudem::BodyMotion bodyMotion() override;
  void setSums(const gpudem::WallSums &sums) override;

 private:
  /// Contacts of atom \p i with what they keep, without those of no use. \return numbers written
  int packContacts(int i, double *buffer) const;
  void unpackContacts(int i, const double *buffer, int count);
  int slotSize() const { return numbers() / in.wall.mostContacts; }
  void sumOverRanks();
  void sumZones();
  void report();
  double elapsed() const;
  /// Let servo and faces see the sums, if it is their step.
  void sample();
  void writeFaces();

  SurfaceArguments in;
  std::unique_ptr<gpudem::SurfaceWall> wallOnHost;  ///< made at the first force on the host
  double **kept = nullptr;                          ///< [nmax][numbers()] contacts
  bigint timeOrigin;                                ///< step at which the motion began
  gpudem::Array3 reference{};                       ///< of torques, at its first place (distance)
  gpudem::WallSums sums;                            ///< of this rank
  gpudem::BodyMotion motionOfSums;                  ///< motion at the step of the sums
  double vector[13] = {};                           ///< output, valid if summed
  std::vector<double> zoneArray;                    ///< [zones][7], valid if zonesSummed
  bool summed = false, zonesSummed = false;
  bigint sampledStep;                               ///< the last step that servo and faces saw
  std::unique_ptr<gpudem::FaceLoads> faces;
};

}  // namespace LAMMPS_NS
#endif
