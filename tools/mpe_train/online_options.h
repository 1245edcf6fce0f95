#pragma once
// The settings of an online training run as options.

#include <folk/tools/program/program.h>

#include <folk/mpe/online/settings.h>

namespace folk::tools {

/// An option for each setting but the threads, its help with the default.
void add_online_options(po::options_description& options);

/// The defaults with the options that are given. Throws UsageError.
mpe::OnlineSettings online_settings(const po::variables_map& values);

}  // namespace folk::tools
