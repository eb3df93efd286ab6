#pragma once

#include "runtime/program/program.h"

namespace nacre {

/// `program` with what depends on one bounded number alone looked up: where it costs more than that
/// and a table is nowhere further off than `error` (see fit_piecewise). Fresnel's factors of a
/// metal of given indices, what a film of given thickness does to colours, energy that facets of
/// given roughness return: of a cosine all of them. Where no table is as close, parts of what a
/// value is computed from, with what becomes of their errors (plan.h). Of the entry's values;
/// measured against double precision when it is compiled. Before expand_math, with derivatives
/// made. The same Program gives the same tables on every machine.
Program tabulate(const Program& program, double error);

}  // namespace nacre
