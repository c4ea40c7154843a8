#include "poinsot/math/inertia.h"

#include <Eigen/Eigenvalues>

namespace poinsot {

Vec3 principal_moments(const Mat3& J) {
  return Eigen::SelfAdjointEigenSolver<Mat3>(J, Eigen::EigenvaluesOnly).eigenvalues();
}

bool is_physical_inertia(const Mat3& J, double slack) {
  if (!J.allFinite()) return false;
  const double scale = J.cwiseAbs().maxCoeff();
  if ((J - J.transpose()).cwiseAbs().maxCoeff() > slack * scale) return false;
  const Vec3 moments = principal_moments(J);
  return moments[0] > 0 && moments[2] <= (moments[0] + moments[1]) * (1 + slack);
}

}  // namespace poinsot
