// SPDX-License-Identifier: Apache-2.0
// The terms of contacts with a wall's line where they cancel, in two words that are both good.
//   (1) a x b
//   (2) side e x q - m |e|   q, m: a position and a radius [m], or a velocity and a rate of growth
//       [m/s]; e [m]: the wall's edge; side: +1 or -1, the sign of e x q
// Source: sums in three words: Ogita, Rump, Oishi, SIAM J. Sci. Comput. 26 (2005) 1955 (SumK).
// Deviation: the third word of |e| comes from what is left of |e|^2.
// Accuracy: 2^-60 of the result or better (where it is about to get its third word), which is 2^-8
//   ulp: contact_time/accelerated_wall_test.cpp and growing_test.cpp measure the times.
// Preconditions: normalised double words, products within the range of S. Wide scalars: plain (2).
#pragma once

#include "contact_time/contact_time.hpp"
#include "stoss/engine/double_word.hpp"

namespace stoss::engine::detail {

/// The sum of the absolute values of a cross product's two terms.
template <class S>
[[nodiscard]] inline S cross_terms(const DoubleWord2<S>& a, const DoubleWord2<S>& b) noexcept {
  return S(magnitude(S(a.x.hi * b.y.hi)) + magnitude(S(a.y.hi * b.x.hi)));
}

/// (1) in three words, rounded to two.
template <class S>
[[nodiscard]] inline DoubleWord<S> cross_in_three_words(const DoubleWord2<S>& a,
                                                        const DoubleWord2<S>& b) noexcept {
  LongSum<S> sum;
  sum.add_product(a.x, b.y);
  sum.add_product(-a.y, b.x);
  return sum.two_words();
}

/// (1) in two words, of three where it cancels.
template <class S>
[[nodiscard]] inline DoubleWord<S> accurate_cross(const DoubleWord2<S>& a,
                                                  const DoubleWord2<S>& b) noexcept {
  const DoubleWord<S> result = cross(a, b);
  if (magnitude(result.hi) < S(kThirdWordShare) * epsilon<S>() * cross_terms(a, b)) {
    return cross_in_three_words(a, b);
  }
  return result;
}

/// (2) in three words, rounded to two.
template <class S>
[[nodiscard]] inline DoubleWord<S> face_gap_in_three_words(const DoubleWord2<S>& q,
                                                           const DoubleWord2<S>& edge,
                                                           const DoubleWord<S>& m,
                                                           int side) noexcept {
  const DoubleWord<S> length = sqrt(square_norm(edge));
  LongSum<S> root;
  root.add_product(edge.x, edge.x);
  root.add_product(edge.y, edge.y);
  root.add_product(-length, length);
  const S third = to_scalar(root.two_words()) / (length.hi + length.hi);
  const DoubleWord2<S> turned = side < 0 ? -edge : edge;
  LongSum<S> sum;
  sum.add_product(turned.x, q.y);
  sum.add_product(-turned.y, q.x);
  sum.add_product(-length, m);
  sum.add(S(-m.hi * third));
  return sum.two_words();
}

template <class S>
[[nodiscard]] inline DoubleWord<S> face_gap_in_three_words(const DoubleWord2<S>& q,
                                                           const DoubleWord2<S>& edge,
                                                           const S& m,
                                                           int side) noexcept {
  return face_gap_in_three_words(q, edge, DoubleWord<S>{m, S(0)}, side);
}

/// (2) in two words, of three where it cancels.
template <class S>
[[nodiscard]] inline DoubleWord<S> accurate_face_gap(const DoubleWord2<S>& q,
                                                     const DoubleWord2<S>& edge,
                                                     const DoubleWord<S>& m,
                                                     int side) noexcept {
  const DoubleWord<S> h = cross(edge, q);
  const DoubleWord<S> gap = (side < 0 ? -h : h) - sqrt(square_norm(edge)) * m;
  if (magnitude(gap.hi) < S(kThirdWordShare) * epsilon<S>() * cross_terms(edge, q)) {
    return face_gap_in_three_words(q, edge, m, side);
  }
  return gap;
}

template <class S>
[[nodiscard]] inline DoubleWord<S> accurate_face_gap(const DoubleWord2<S>& q,
                                                     const DoubleWord2<S>& edge,
                                                     const S& m,
                                                     int side) noexcept {
  return accurate_face_gap(q, edge, DoubleWord<S>{m, S(0)}, side);
}

}  // namespace stoss::engine::detail
