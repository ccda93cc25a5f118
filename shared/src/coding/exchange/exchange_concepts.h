// What a coder requires of an exchange: each coder names only the queries that it makes.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "grid/lattice.h"

namespace isostar {

/// A coder, and the accounting of bytes and memory.
template <class E>
concept AnyExchange = requires(E& e) {
  e.coder();
  { e.exhausted() } -> std::convertible_to<bool>;
  { e.charge(uint64_t{}) } -> std::convertible_to<bool>;
  e.visitBrick();
  e.visit(uint64_t{});
};

/// Signs of single vertices, and the first simplex of the next component (§5.1).
template <class E, int D>
concept BaseExchange = AnyExchange<E> &&
    requires(E& e, Coordinates<D> v, Lattice<D> lattice, std::vector<uint8_t> seen) {
  { e.positive(v) } -> std::convertible_to<bool>;
  e.nextSeed(lattice, seen);
};

/// Signs, row by row of a brick (§5.2).
template <class E>
concept SignExchange = AnyExchange<E> && requires(E& e, std::size_t brickIndex) {
  { e.row(brickIndex, brickIndex) } -> std::convertible_to<uint32_t>;
  { e.varies(brickIndex, uint32_t{}) } -> std::convertible_to<bool>;
};

/// Which cells of an adaptive mesh are kept (§5.2).
template <class E>
concept KeepExchange = AnyExchange<E> && requires(E& e, std::size_t brickIndex) {
  { e.keptRow(brickIndex, brickIndex) } -> std::convertible_to<uint32_t>;
};

/// Scalars (§5.3).
template <class E>
concept MagnitudeExchange = AnyExchange<E> && requires(E& e, std::size_t brickIndex) {
  { e.magnitude(brickIndex, brickIndex, 0) } -> std::convertible_to<uint32_t>;
  { e.gradient(brickIndex) } -> std::convertible_to<int>;
  { e.selected(brickIndex) } -> std::convertible_to<bool>;
};

template <class E>
concept DisplacementExchange = AnyExchange<E> && requires(E& e, std::size_t brickIndex) {
  { e.displacement(brickIndex, brickIndex) } -> std::convertible_to<int>;
};

template <class E>
concept DomainExchange = AnyExchange<E> && requires(E& e, std::size_t brickIndex) {
  { e.domain(brickIndex, brickIndex, 0) } -> std::convertible_to<int32_t>;
};

/// All queries of a whole stream.
template <class E, int D>
concept CodecExchange = BaseExchange<E, D> && SignExchange<E> && KeepExchange<E> &&
    MagnitudeExchange<E> && DisplacementExchange<E> && DomainExchange<E> && requires(E& e) {
  e.filter();
  e.enterLevel(0);
};

}  // namespace isostar
