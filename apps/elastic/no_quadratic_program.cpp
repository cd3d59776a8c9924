// Where the program is built without the solver.
#include <stdexcept>

#include "elastic/quadratic_program.hpp"

namespace elastic {

bool has_quadratic_solver() { return false; }

QuadraticSolution solve(const QuadraticProgram&, double, double) {
  throw std::logic_error("this program is built without a solver of quadratic programs");
}

}  // namespace elastic
