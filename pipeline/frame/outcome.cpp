#include "pipeline/frame/outcome.h"

#include <stdexcept>

namespace mammotwin {

std::string name_of(Status status) {
  switch (status) {
    case Status::ok:
      return "ok";
    case Status::look:
      return "look";
    case Status::refused:
      return "refused";
    case Status::not_converged:
      return "not_converged";
  }
  throw std::logic_error("unknown status");
}

int exit_code(Status status) {
  switch (status) {
    case Status::ok:
    case Status::look:
      return 0;
    case Status::refused:
      return 1;
    case Status::not_converged:
      return 3;
  }
  throw std::logic_error("unknown status");
}

}  // namespace mammotwin
