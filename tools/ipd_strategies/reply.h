#pragma once
// `ipd-strategies reply`: the best reply to a machine, or the best memory-one reply found to several.

#include <folk/tools/program/program.h>

#include <folk/games/payoffs.h>
#include <folk/games/progress.h>

#include <nlohmann/json.hpp>
#include <string>

namespace folk::tools {

/// Adds the options of reply: criterion, noise, horizon, memory-one, threads.
void add_reply_options(po::options_description& options);

/// Answers `ipd-strategies reply OPPONENTS` on stdout. Without --memory-one OPPONENTS is one machine, and the reply is
/// exact; with it OPPONENTS is a SPEC of machines that are met equally often.
int reply(const std::string& opponents, const Payoffs& payoffs, const po::variables_map& values, const Common& common);

/// The same as what --format json prints. `progress` is told of the search for a memory-one reply.
nlohmann::ordered_json reply_json(const std::string& opponents, const Payoffs& payoffs, const po::variables_map& values,
                                  const Common& common, const Progress& progress);

}  // namespace folk::tools
