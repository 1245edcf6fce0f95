#pragma once
// Messages of the programs in the words of Python.

#include <string>

namespace folk::python {

/// Options as arguments of a call: "--noise 2" as "noise=2", "--class" as "class_=". What a message says of another
/// program's command line ("ipd-tournament --format json") stays.
std::string in_python(const std::string& message);

}  // namespace folk::python
