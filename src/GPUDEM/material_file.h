// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Material files (*.gran): materials by name, what is measured of pairs of them, and the law made of these.
/// doc/Howto_materials.md has the syntax.
#ifndef LMP_GPUDEM_MATERIAL_FILE_H
#define LMP_GPUDEM_MATERIAL_FILE_H

#include "gpudem/material.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;

class MaterialFile {
 public:
  /// Find and read \p name; all ranks call. Ends the run with a message that names file, line, word and what is
  /// allowed. \param command "Pair_coeff", "Fix wall/gran": begins the messages
  MaterialFile(LAMMPS *lmp, const std::string &command, const std::string &name);

  /// Is \p word meant as the name of a material file?
  static bool isName(const std::string &word);

  /// Ends the run if the file does not have it.
  const gpudem::Material &material(const std::string &name) const;
  /// The law of two materials; ends the run if the file does not have the pair.
  gpudem::ContactModel model(const std::string &a, const std::string &b, gpudem::Partner partner) const;

 private:
  template <class Thing>
  struct Read {
    Thing thing;
    int line;
  };
  using Names = std::pair<std::string, std::string>;
  static Names ordered(const std::string &a, const std::string &b) { return a < b ? Names{a, b} : Names{b, a}; }

  std::string text();
  void checkHeader(const std::string &line) const;
  void readLine(const std::vector<std::string> &words);
  void readMaterial(const std::vector<std::string> &words);
  void readPair(const std::vector<std::string> &words);
  void readLaw(const std::vector<std::string> &words);
  void checkPairs();
  template <class Of>
  void readNumber(Of &of, const std::vector<gpudem::NumberOf<Of>> &numbers, const std::vector<std::string> &words,
                  std::size_t &at, std::vector<bool> &given) const;
  template <class Of>
  void readNumbers(Of &of, const std::vector<gpudem::NumberOf<Of>> &numbers, const std::vector<std::string> &words,
                   std::size_t first) const;
  std::string known() const;
  [[noreturn]] void fail(const std::string &what) const;  ///< about the file
  [[noreturn]] void failAt(int line, const std::string &what) const;
  [[noreturn]] void failLine(const std::string &what) const;  ///< about line_

  LAMMPS *lmp_;
  std::string command_, name_, path_;
  int line_ = 0;  ///< being read
  std::map<std::string, Read<gpudem::Material>> materials_;
  std::map<Names, Read<gpudem::MaterialPair>> pairs_;
  Read<gpudem::MaterialLaw> law_{{}, 0};
};

}  // namespace LAMMPS_NS
#endif
