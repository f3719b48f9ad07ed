// Robots as `peers dump` writes them, and the answers to `peers race`: what every C++ contestant shares.
#pragma once

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iostream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

/// A moving body: the joint that carries it (axis z), where it stands in its parent, what it weighs.
struct Body {
  int parent;  // -1: the world
  std::string joint, kind;
  int q, v;                        // where its coordinates and degrees of freedom begin
  std::array<double, 9> rotation;  // to the parent's frame, by rows
  std::array<double, 3> position;
  double mass;
  std::array<double, 3> com;
  std::array<double, 6> inertia;  // about the centre of mass: xx, xy, xz, yy, yz, zz
};

/// A state and what is asked of it: accelerations or forces.
struct Sample {
  std::vector<double> q, v, x;
};

struct Robot {
  std::string name;
  int nq, nv;
  std::array<double, 3> gravity;
  std::vector<Body> bodies;
  std::vector<Sample> samples;
};

template <typename Numbers>
void read(std::istream& in, Numbers& numbers) {
  for (auto& number : numbers) in >> number;
}

inline Robot read_robot(const std::string& path) {
  std::ifstream in(path);
  Robot robot;
  std::size_t bodies, samples;
  in >> robot.name >> robot.nq >> robot.nv >> bodies >> samples;
  read(in, robot.gravity);
  robot.bodies.resize(bodies);
  for (Body& b : robot.bodies) {
    in >> b.parent >> b.joint >> b.kind >> b.q >> b.v;
    read(in, b.rotation);
    read(in, b.position);
    in >> b.mass;
    read(in, b.com);
    read(in, b.inertia);
  }
  robot.samples.resize(samples);
  for (Sample& s : robot.samples) {
    s.q.resize(robot.nq);
    s.v.resize(robot.nv);
    s.x.resize(robot.nv);
    read(in, s.q);
    read(in, s.v);
    read(in, s.x);
  }
  if (!in) {
    std::cerr << path << ": not a robot\n";
    std::exit(1);
  }
  return robot;
}

/// A quantity of one robot: `compute(k)` for sample k, and what came out, in eigenbody's order and frames.
struct Quantity {
  std::function<void(std::size_t)> compute;
  std::function<std::vector<double>()> result;
};

/// Answers `time ROBOT QUANTITY` by seconds a call and `value ROBOT QUANTITY` by the numbers of sample 0.
inline void serve(std::map<std::string, Quantity>& quantities, std::size_t samples) {
  const double long_enough = 2e-3;
  std::string line;
  while (std::getline(std::cin, line)) {
    const auto space = line.find(' ');
    const auto found = quantities.find(line.substr(space + 1));
    if (found == quantities.end()) {
      std::printf("none\n");
    } else if (line.substr(0, space) == "value") {
      found->second.compute(0);
      for (double x : found->second.result()) std::printf("%.17g ", x);
      std::printf("\n");
    } else {
      const auto run = [&](double at_least) {
        const auto start = std::chrono::steady_clock::now();
        std::size_t calls = 0;
        double seconds = 0;
        while (seconds < at_least) {
          for (std::size_t k = 0; k < samples; ++k) found->second.compute(k);
          calls += samples;
          seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        }
        return seconds / static_cast<double>(calls);
      };
      run(long_enough / 2);  // memory near, the processor awake
      std::printf("%.6e\n", run(long_enough));
    }
    std::fflush(stdout);
  }
}
