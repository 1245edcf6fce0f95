#pragma once
// `ipd-strategies equilibria`: from which patience on each strategy of a SPEC is in equilibrium with its copy.

#include <folk/tools/program/program.h>

#include <folk/games/payoffs.h>

#include <string>

namespace folk::tools {

/// Answers `ipd-strategies equilibria SPEC` on stdout.
int equilibria(const std::string& spec, const Payoffs& payoffs, const po::variables_map& values, const Common& common);

}  // namespace folk::tools
