#pragma once
// A machine and what it is called.

#include <folk/strategies/strategy.h>

#include <memory>
#include <string>
#include <utility>

namespace folk {

template <class M>
Strategy named_machine(std::string name, M machine) {
  return {std::move(name), std::make_shared<M>(std::move(machine)), nullptr};
}

}  // namespace folk
