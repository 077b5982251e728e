// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the files that use CGAL's Nef polyhedra share.
#ifndef TOUCHSTONE_EXACT_NEF_KERNEL_INTERNAL_H_
#define TOUCHSTONE_EXACT_NEF_KERNEL_INTERNAL_H_

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Nef_polyhedron_3.h>

#include "touchstone/exact/integer.h"
#include "touchstone/exact/nef_sum_internal.h"

namespace touchstone::exact {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Nef = CGAL::Nef_polyhedron_3<Kernel>;

// By way of decimal text: whatever the kernel's exact type is, both sides read and write it.
Kernel::FT ToField(const Integer& value);
Kernel::FT ToField(const mpq_class& value);
mpq_class ToRational(const Kernel::FT& value);

// The solid that the loops bound: cavities and several components are allowed.
Nef MakeNef(const IntegerPolyhedron& body);

}  // namespace touchstone::exact

#endif  // TOUCHSTONE_EXACT_NEF_KERNEL_INTERNAL_H_
