// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Reading members for which LAMMPS offers no accessor. For lammps_compat*.cpp only.
///
/// Explicit instantiation may name private members ([temp.spec.general] of the C++ standard), which is how a plugin can
/// read them without touching LAMMPS' sources.
#ifndef LMP_GPUDEM_LAMMPS_EXPOSE_H
#define LMP_GPUDEM_LAMMPS_EXPOSE_H

namespace {
template <class Tag, typename Tag::type member>
struct Expose {
  friend typename Tag::type reach(Tag) { return member; }
};
}  // namespace

#define GPUDEM_EXPOSE(tag, owner, member_type, member) \
  struct tag {                                         \
    using type = member_type owner::*;                 \
    friend type reach(tag);                            \
  };                                                   \
  template struct Expose<tag, &owner::member>

#endif
