// The compressed-column copy is the matrix.
#include <algorithm>

#include <gtest/gtest.h>

#include "solver/linear/csc_map.hpp"
#include "tests/solver/linear/random_chains.hpp"

namespace hawser {

namespace {

using test::Kind;
using test::Shape;

const std::vector<Shape> shapes = {{6, 3}, {3, 1}, {3, 4}};

Eigen::MatrixXd dense(const CscMap& map) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(map.unknowns(), map.unknowns());
  for (int j = 0; j < map.unknowns(); ++j)
    for (int k = map.column_start[j]; k < map.column_start[j + 1]; ++k) a(map.row[k], j) = map.value[k];
  return a;
}

TEST(CscMap, HoldsTheWholeMatrixOrItsUpperTriangle) {
  CscMap whole(test::random_matrix(Kind::unsymmetric, shapes, 1), CscMap::Part::whole);
  CscMap upper(test::random_matrix(Kind::unsymmetric, shapes, 1), CscMap::Part::upper);
  const BlockTridiagonal other = test::random_matrix(Kind::unsymmetric, shapes, 2);
  whole.copy_values(other);
  upper.copy_values(other);
  const Eigen::MatrixXd a = test::dense(other);
  EXPECT_EQ(dense(whole), a);
  EXPECT_EQ(dense(upper), Eigen::MatrixXd(a.triangularView<Eigen::Upper>()));
}

TEST(CscMap, LeavesOutThePaddingAndSortsRows) {
  const CscMap map(test::random_matrix(Kind::unsymmetric, shapes, 1), CscMap::Part::whole);
  EXPECT_EQ(map.value.size(), 36u * (3 + 2 * 2) + 9u * 1 + 9u * (4 + 2 * 3));
  for (int j = 0; j < map.unknowns(); ++j)
    EXPECT_TRUE(std::is_sorted(map.row.begin() + map.column_start[j], map.row.begin() + map.column_start[j + 1]));
}

}  // namespace

}  // namespace hawser
