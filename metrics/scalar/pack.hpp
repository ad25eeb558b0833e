// Pack<W>: W doubles side by side, one ray in each lane; arithmetic is that of double in every lane, bit for bit.
//
// W is 1, 2, 4 or 8. A pack is one register of the compiler's vector extension where the target has one that wide, else
// two packs of half the width, so every width works and gives the same bits on every instruction set.
// std::experimental::simd is not used: its masked assignment is broken under clang with AVX-512 and its functions at
// width 1 are those of libm.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include "metrics/scalar/scalar.hpp"

namespace xpr {

template <int W>
struct Pack;
template <int W>
struct Mask;

namespace registers {

#if defined(__AVX512F__)
inline constexpr int native_lanes = 8;
#elif defined(__AVX__)
inline constexpr int native_lanes = 4;
#else
inline constexpr int native_lanes = 2;
#endif

/// A register wider than the machine's: two halves.
template <class Half>
struct Split {
  Half lo{};
  Half hi{};
};

template <class R>
inline constexpr bool is_split = false;
template <class Half>
inline constexpr bool is_split<Split<Half>> = true;

// g++ accepts vector_size in a template only where the element type depends on a parameter too.
template <class Element, int W>
struct RegisterOf {
  typedef Element type __attribute__((vector_size(W * sizeof(Element))));
};
template <class Element>
struct RegisterOf<Element, 1> {
  using type = Element;
};
template <class Element, int W>
requires(W > native_lanes) struct RegisterOf<Element, W> {
  using type = Split<typename RegisterOf<Element, W / 2>::type>;
};

/// W elements as the machine holds them.
template <class Element, int W>
using Register = typename RegisterOf<Element, W>::type;

// The two compilers choose different 64-bit integers for the outcome of a vector comparison.
template <class R>
struct ComparisonOf {
  using type = decltype(std::declval<const R&>() < std::declval<const R&>());
};
template <class Half>
struct ComparisonOf<Split<Half>> {
  using type = Split<typename ComparisonOf<Half>::type>;
};

/// What comparing two registers of W doubles gives: one bool, or all-ones and all-zeros integers.
template <int W>
using MaskRegister = typename ComparisonOf<Register<double, W>>::type;

/// Applies f to whole registers of the machine.
template <class F, class R, class... Rs>
[[gnu::always_inline]] constexpr auto map(const F& f, const R& first, const Rs&... rest) {
  if constexpr (is_split<R>) {
    using Half = decltype(map(f, first.lo, rest.lo...));
    return Split<Half>{map(f, first.lo, rest.lo...), map(f, first.hi, rest.hi...)};
  } else {
    return f(first, rest...);
  }
}

/// The bits of a double or of a register of doubles, as unsigned integers.
template <class R>
using Bits = std::conditional_t<std::is_same_v<R, double>, std::uint64_t,
                                typename RegisterOf<std::uint64_t, static_cast<int>(sizeof(R) / sizeof(double))>::type>;

/// All W elements equal to x. Not `R{} + x`, which would turn -0 into +0.
template <int W>
[[gnu::always_inline]] constexpr Register<double, W> broadcast(double x) {
  if constexpr (W == 1) {
    return x;
  } else if constexpr (W > native_lanes) {
    return {broadcast<W / 2>(x), broadcast<W / 2>(x)};
  } else {
    return [x]<std::size_t... I>(std::index_sequence<I...>) {
      return Register<double, W>{(static_cast<void>(I), x)...};
    }
    (std::make_index_sequence<static_cast<std::size_t>(W)>{});
  }
}

template <int W, class R>
[[gnu::always_inline]] constexpr auto get(const R& r, int i) {
  if constexpr (W == 1) {
    return r;
  } else if constexpr (is_split<R>) {
    return i < W / 2 ? get<W / 2>(r.lo, i) : get<W / 2>(r.hi, i - W / 2);
  } else {
    return r[i];
  }
}

template <int W, class R, class Element>
[[gnu::always_inline]] constexpr void set(R& r, int i, Element x) {
  if constexpr (W == 1) {
    r = x;
  } else if constexpr (is_split<R>) {
    i < W / 2 ? set<W / 2>(r.lo, i, x) : set<W / 2>(r.hi, i - W / 2, x);
  } else {
    r[i] = x;
  }
}

/// The correctly rounded square root of every element, in one instruction where the machine has it.
template <class R>
[[gnu::always_inline]] constexpr R square_root(const R& r) {
  if constexpr (std::is_same_v<R, double>) {
    return __builtin_sqrt(r);
  } else {
#if defined(__SSE2__)
    if (!std::is_constant_evaluated()) {
      if constexpr (sizeof(R) == 16) return reinterpret_cast<R>(_mm_sqrt_pd(reinterpret_cast<__m128d>(r)));
#if defined(__AVX__)
      if constexpr (sizeof(R) == 32) return reinterpret_cast<R>(_mm256_sqrt_pd(reinterpret_cast<__m256d>(r)));
#endif
#if defined(__AVX512F__)
      if constexpr (sizeof(R) == 64)
        return reinterpret_cast<R>(_mm512_maskz_sqrt_pd(0xff, reinterpret_cast<__m512d>(r)));
#endif
    }
#endif
    return [&r]<std::size_t... I>(std::index_sequence<I...>) { return R{__builtin_sqrt(r[I])...}; }
    (std::make_index_sequence<sizeof(R) / sizeof(double)>{});
  }
}

/// Whether some element of the outcome of a comparison is true.
template <class R>
[[gnu::always_inline]] constexpr bool some(const R& r) {
  if constexpr (is_split<R>) {
    return some(r.lo) || some(r.hi);
  } else if constexpr (std::is_integral_v<R>) {
    return r != 0;
  } else {
#if defined(__AVX__)
    if (!std::is_constant_evaluated()) {
      if constexpr (sizeof(R) == 32) return _mm256_movemask_pd(reinterpret_cast<__m256d>(r)) != 0;
    }
#endif
    bool found = false;
    for (std::size_t i = 0; i < sizeof(R) / sizeof(r[0]); ++i) found = found || r[i] != 0;
    return found;
  }
}

}  // namespace registers

/// The outcome of comparing two Pack<W>: one truth value a lane. Combine with & | ^ !, ask with any and all, use with
/// select.
template <int W>
struct Mask {
  static_assert(W == 1 || W == 2 || W == 4 || W == 8);
  registers::MaskRegister<W> reg{};

  constexpr Mask() = default;
  /// The same truth value in every lane.
  explicit constexpr Mask(bool everywhere) {
    for (int i = 0; i < W; ++i) set_lane(*this, i, everywhere);
  }

  [[nodiscard]] static constexpr Mask wrap(const registers::MaskRegister<W>& r) {
    Mask m;
    m.reg = r;
    return m;
  }

  [[nodiscard, gnu::always_inline]] friend constexpr Mask operator&(const Mask& a, const Mask& b) {
    return wrap(registers::map([]<class R>(const R& x, const R& y) { return static_cast<R>(x & y); }, a.reg, b.reg));
  }
  [[nodiscard, gnu::always_inline]] friend constexpr Mask operator|(const Mask& a, const Mask& b) {
    return wrap(registers::map([]<class R>(const R& x, const R& y) { return static_cast<R>(x | y); }, a.reg, b.reg));
  }
  [[nodiscard, gnu::always_inline]] friend constexpr Mask operator^(const Mask& a, const Mask& b) {
    return wrap(registers::map([]<class R>(const R& x, const R& y) { return static_cast<R>(x ^ y); }, a.reg, b.reg));
  }
  [[nodiscard, gnu::always_inline]] friend constexpr Mask operator!(const Mask& a) {
    return wrap(registers::map([](const auto& x) { return x == 0; }, a.reg));
  }

  [[nodiscard]] friend constexpr bool lane(const Mask& m, int i) { return registers::get<W>(m.reg, i) != 0; }
  friend constexpr void set_lane(Mask& m, int i, bool value) {
    if constexpr (W == 1) {
      m.reg = value;
    } else {
      registers::set<W>(m.reg, i, value ? std::int64_t{-1} : std::int64_t{0});
    }
  }

  [[nodiscard, gnu::always_inline]] friend constexpr bool any(const Mask& m) { return registers::some(m.reg); }
  [[nodiscard, gnu::always_inline]] friend constexpr bool all(const Mask& m) { return !any(!m); }

  /// a where the mask holds, else b, lane by lane.
  [[nodiscard, gnu::always_inline]] friend constexpr Pack<W> select(const Mask& m, const Pack<W>& a, const Pack<W>& b) {
    return Pack<W>::wrap(
        registers::map([](const auto& c, const auto& x, const auto& y) { return c ? x : y; }, m.reg, a.reg, b.reg));
  }
};

/// W doubles. A double or an int stands for the same number in every lane.
template <int W>
struct Pack {
  static_assert(W == 1 || W == 2 || W == 4 || W == 8);
  using Register = registers::Register<double, W>;
  Register reg{};

  constexpr Pack() = default;
  [[gnu::always_inline]] constexpr Pack(double x) : reg(registers::broadcast<W>(x)) {}  // implicit: 2.0 * x
  [[nodiscard, gnu::always_inline]] static constexpr Pack wrap(const Register& r) {
    Pack p;
    p.reg = r;
    return p;
  }

  /// Reads W doubles from `source`, which needs no alignment.
  [[nodiscard]] static constexpr Pack load(const double* source) {
    Pack p;
    for (int i = 0; i < W; ++i) registers::set<W>(p.reg, i, source[i]);
    return p;
  }
  /// Writes the W lanes to `target`.
  constexpr void store(double* target) const {
    for (int i = 0; i < W; ++i) target[i] = registers::get<W>(reg, i);
  }

  [[nodiscard]] friend constexpr double lane(const Pack& p, int i) { return registers::get<W>(p.reg, i); }
  friend constexpr void set_lane(Pack& p, int i, double value) { registers::set<W>(p.reg, i, value); }

  [[nodiscard, gnu::always_inline]] friend constexpr Pack operator+(const Pack& a) { return a; }
  [[nodiscard, gnu::always_inline]] friend constexpr Pack operator-(const Pack& a) {
    return wrap(registers::map([](const auto& x) { return -x; }, a.reg));
  }
  [[nodiscard, gnu::always_inline]] friend constexpr Pack operator+(const Pack& a, const Pack& b) {
    return wrap(registers::map([](const auto& x, const auto& y) { return x + y; }, a.reg, b.reg));
  }
  [[nodiscard, gnu::always_inline]] friend constexpr Pack operator-(const Pack& a, const Pack& b) {
    return wrap(registers::map([](const auto& x, const auto& y) { return x - y; }, a.reg, b.reg));
  }
  [[nodiscard, gnu::always_inline]] friend constexpr Pack operator*(const Pack& a, const Pack& b) {
    return wrap(registers::map([](const auto& x, const auto& y) { return x * y; }, a.reg, b.reg));
  }
  [[nodiscard, gnu::always_inline]] friend constexpr Pack operator/(const Pack& a, const Pack& b) {
    return wrap(registers::map([](const auto& x, const auto& y) { return x / y; }, a.reg, b.reg));
  }
  [[gnu::always_inline]] friend constexpr Pack& operator+=(Pack& a, const Pack& b) { return a = a + b; }
  [[gnu::always_inline]] friend constexpr Pack& operator-=(Pack& a, const Pack& b) { return a = a - b; }
  [[gnu::always_inline]] friend constexpr Pack& operator*=(Pack& a, const Pack& b) { return a = a * b; }
  [[gnu::always_inline]] friend constexpr Pack& operator/=(Pack& a, const Pack& b) { return a = a / b; }

  [[nodiscard, gnu::always_inline]] friend constexpr Mask<W> operator<(const Pack& a, const Pack& b) {
    return Mask<W>::wrap(registers::map([](const auto& x, const auto& y) { return x < y; }, a.reg, b.reg));
  }
  [[nodiscard, gnu::always_inline]] friend constexpr Mask<W> operator<=(const Pack& a, const Pack& b) {
    return Mask<W>::wrap(registers::map([](const auto& x, const auto& y) { return x <= y; }, a.reg, b.reg));
  }
  [[nodiscard, gnu::always_inline]] friend constexpr Mask<W> operator>(const Pack& a, const Pack& b) { return b < a; }
  [[nodiscard, gnu::always_inline]] friend constexpr Mask<W> operator>=(const Pack& a, const Pack& b) { return b <= a; }
  [[nodiscard, gnu::always_inline]] friend constexpr Mask<W> operator==(const Pack& a, const Pack& b) {
    return Mask<W>::wrap(registers::map([](const auto& x, const auto& y) { return x == y; }, a.reg, b.reg));
  }
  [[nodiscard, gnu::always_inline]] friend constexpr Mask<W> operator!=(const Pack& a, const Pack& b) {
    return Mask<W>::wrap(registers::map([](const auto& x, const auto& y) { return x != y; }, a.reg, b.reg));
  }

  /// The correctly rounded square root; NaN below zero.
  [[nodiscard, gnu::always_inline]] friend constexpr Pack sqrt(const Pack& a) {
    return wrap(registers::map([](const auto& x) { return registers::square_root(x); }, a.reg));
  }
};

template <int W>
inline constexpr int lanes<Pack<W>> = W;

template <class T>
inline constexpr bool is_pack = false;
template <int W>
inline constexpr bool is_pack<Pack<W>> = true;

/// The scalars that the machine's own arithmetic is made for: what the elementary functions are written over.
template <class T>
concept MachineScalar = std::is_same_v<T, double> || is_pack<T>;

}  // namespace xpr
