#include "reckon/harness/process_estimator.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <sstream>
#include <thread>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace reckon::harness {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// What every child of these tests begins with.
constexpr const char* kPrelude = R"(
import json, os, signal, sys, time
def read(): return json.loads(sys.stdin.readline())
def say(x): print(x if isinstance(x, str) else json.dumps(x), flush=True)
def begin():
    hello, start = read(), read()
    say({"ready": True, "error": "right_invariant"})
    return hello, start
def belief(m): return {"t_ns": m["valid_ns"], "q_WB": [1, 0, 0, 0], "p_WB": [0, 0, 0],
                       "v_WB": [m["sensor"], 0, 0]}
)";

estimator::Setup TwoSensors() {
  estimator::Setup setup;
  setup.suite.sensors = {{"imu", models::SensorKind::kImu, {}, 5'000'000},
                         {"wheels", models::SensorKind::kEncoders, {}, 20'000'000}};
  return setup;
}

models::Measurement Imu(models::TimeNs t_ns) {
  return {0, t_ns, t_ns, models::ImuSample{{0.1, 0, 0}, {0, 0, 9.81}, 5'000'000, false, false}};
}

ProcessOptions Options(std::vector<std::string> command, double timeout_s = 20.0) {
  return {"mine", std::move(command), fs::temp_directory_path(), timeout_s, "husky"};
}

ProcessEstimator Child(const std::string& script, double timeout_s = 20.0) {
  return ProcessEstimator(Options({"python3", "-c", kPrelude + script}, timeout_s), TwoSensors());
}

std::string Failure(const std::function<void()>& action) {
  try {
    action();
  } catch (const ProcessFailure& failure) {
    return failure.what();
  }
  return "no failure";
}

testing::AssertionResult Says(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "'" << part << "' is not in: " << text;
}

double SecondsOf(const std::function<void()>& action) {
  const auto before = std::chrono::steady_clock::now();
  action();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
}

TEST(ProcessEstimator, AnswersBecomeBeliefs) {
  auto child = Child(R"(
begin()
read(); say({})
say(belief(read()))
)");
  child.Start({});
  EXPECT_FALSE(child.Belief());
  EXPECT_FALSE(child.Process(Imu(10)).propagated);
  EXPECT_FALSE(child.Belief());
  EXPECT_TRUE(child.Process(Imu(20)).propagated);
  ASSERT_TRUE(child.Belief());
  EXPECT_EQ(child.Belief()->t_ns, 20);
}

TEST(ProcessEstimator, StartsAgain) {
  auto child = Child(R"(
begin()
say(belief(read()))
read()
say({"ready": True, "error": "multiplicative"})
say(belief(read()))
)");
  child.Start({});
  EXPECT_TRUE(child.Process(Imu(50)).propagated);
  child.Start({});
  EXPECT_FALSE(child.Belief());
  EXPECT_TRUE(child.Process(Imu(10)).propagated);  // time begins anew
  EXPECT_EQ(child.Belief()->form, estimator::ErrorForm::kMultiplicative);
}

/// What a child reads while it is fed one sample of every kind, non-finite numbers among them.
std::string BytesSent(const fs::path& log) {
  std::error_code ignored;
  fs::remove(log, ignored);
  ProcessEstimator child(Options({"python3", "-c", R"(
import sys
log = open(sys.argv[1], "w")
for n, line in enumerate(sys.stdin):
    log.write(line)
    log.flush()
    if n > 0: print("{}" if n > 1 else '{"ready": true, "error": "right_invariant"}', flush=True)
)",
                                  log.string()}),
                         TwoSensors());
  child.Start({});
  auto imu = Imu(7);
  std::get<models::ImuSample>(imu.sample).gyro_rad_s << 0.1, 1.0 / 3.0, 5e-324;
  std::get<models::ImuSample>(imu.sample).accel_m_s2 << std::numeric_limits<double>::quiet_NaN(),
      std::numeric_limits<double>::infinity(), 9.81;
  models::EncoderSample encoders;
  encoders.angle_rad = Eigen::Vector2d(1, 2);
  encoders.rate_rad_s = Eigen::Vector2d(3, 4);
  const bool refused =
      child.Process(imu).refusal != estimator::Refusal::kNone ||
      child.Process({1, 8, 9, encoders}).refusal != estimator::Refusal::kNone ||
      child.Process({1, 9, 9, models::BodyVelocitySample{}}).refusal != estimator::Refusal::kNone;
  EXPECT_FALSE(refused);
  std::ifstream file(log);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(ProcessEstimator, SendsTheSameBytesEveryTime) {
  const fs::path log = fs::path(testing::TempDir()) / "process_estimator_bytes.jsonl";
  const std::string bytes = BytesSent(log);
  EXPECT_EQ(bytes, BytesSent(log));
  std::vector<json> messages;
  std::istringstream lines(bytes);
  for (std::string line; std::getline(lines, line);) messages.push_back(json::parse(line));
  ASSERT_EQ(messages.size(), 5u);
  EXPECT_EQ(messages[0]["message"], "hello");
  EXPECT_EQ(messages[0]["schema"], 1);
  EXPECT_EQ(messages[0]["sensors"][1]["name"], "wheels");
  EXPECT_EQ(messages[1]["message"], "start");
  EXPECT_EQ(messages[1]["covariance"].size(), 225u);
  EXPECT_EQ(messages[2]["message"], "imu");
  EXPECT_EQ(messages[2]["gyro_rad_s"], json({0.1, 1.0 / 3.0, 5e-324}));  // to the last bit
  EXPECT_EQ(messages[2]["accel_m_s2"], json({nullptr, nullptr, 9.81}));
  EXPECT_EQ(messages[3]["message"], "encoders");
  EXPECT_EQ(messages[3]["valid_ns"], 8);
  EXPECT_EQ(messages[3]["arrival_ns"], 9);
  EXPECT_EQ(messages[3]["rate_rad_s"], json({3.0, 4.0}));
  EXPECT_EQ(messages[4]["message"], "body_velocity");
}

TEST(ProcessEstimator, SlowStartIsWaitedFor) {
  auto child = Child("time.sleep(0.4); begin(); say(belief(read()))");
  child.Start({});
  EXPECT_TRUE(child.Process(Imu(10)).propagated);
}

TEST(ProcessEstimator, SilenceEndsWithTheTimeout) {
  ProcessEstimator child(
      Options({"sh", "-c",
               "read hello; read start; echo '{\"ready\": true, \"error\": \"multiplicative\"}';"
               "read line; echo pondering >&2; printf '{\"t_'; exec sleep 60"},
              1.0),
      TwoSensors());
  child.Start({});
  std::string failure;
  const double seconds =
      SecondsOf([&] { failure = Failure([&] { (void)child.Process(Imu(10)); }); });
  EXPECT_GE(seconds, 1.0);
  EXPECT_LT(seconds, 4.0);  // the timeout, 0.2 s to leave, and a loaded machine
  EXPECT_TRUE(Says(failure, "estimator 'mine' (sh -c"));
  EXPECT_TRUE(Says(failure, "measurement 0 (sensor 0, valid at 10 ns)"));
  EXPECT_TRUE(Says(failure, "no whole line came within 1 s after the partial line '{\"t_'"));
  EXPECT_TRUE(Says(failure, "pondering"));
}

TEST(ProcessEstimator, CrashIsToldWithItsTraceback) {
  auto child = Child("begin(); say(belief(read())); read(); raise KeyError('wheel')");
  child.Start({});
  EXPECT_TRUE(child.Process(Imu(10)).propagated);
  const std::string failure = Failure([&] { (void)child.Process(Imu(20)); });
  EXPECT_TRUE(Says(failure, "the program ended with exit code 1"));
  EXPECT_TRUE(Says(failure, "KeyError: 'wheel'"));
  // It stays gone.
  EXPECT_EQ(Failure([&] { (void)child.Process(Imu(30)); }), failure);
  EXPECT_EQ(Failure([&] { child.Start({}); }), failure);
}

TEST(ProcessEstimator, DeathBySignalIsNamed) {
  auto child = Child("begin(); read(); os.kill(os.getpid(), signal.SIGSEGV)");
  child.Start({});
  EXPECT_TRUE(
      Says(Failure([&] { (void)child.Process(Imu(10)); }), "signal 11 (Segmentation fault)"));
}

TEST(ProcessEstimator, MissingScriptIsAFailureOfTheProgram) {
  ProcessEstimator child(Options({"python3", "no_such_filter.py"}), TwoSensors());
  EXPECT_TRUE(Says(Failure([&] { child.Start({}); }), "can't open file"));
}

TEST(ProcessEstimator, GarbageAndNanAreFailures) {
  for (const std::string answer : {"'hello'", "{\"t_ns\": float('nan')}"}) {
    auto child = Child("begin(); read(); say(" + answer + ")");
    child.Start({});
    const std::string failure = Failure([&] { (void)child.Process(Imu(10)); });
    EXPECT_TRUE(Says(failure, "expected one JSON object on one line"));
  }
}

TEST(ProcessEstimator, TalkingUnaskedIsAFailure) {
  auto child = Child("begin(); read(); say('{}\\n{}'); time.sleep(60)");
  child.Start({});
  EXPECT_FALSE(child.Process(Imu(10)).propagated);
  EXPECT_TRUE(Says(Failure([&] { (void)child.Process(Imu(20)); }), "it spoke unasked: '{}"));
}

TEST(ProcessEstimator, EndlessOutputIsAFailure) {
  ProcessEstimator lines(Options({"yes"}), TwoSensors());
  EXPECT_NE(Failure([&] { lines.Start({}); }), "no failure");
  ProcessEstimator one_line(Options({"cat", "/dev/zero"}), TwoSensors());
  EXPECT_NE(Failure([&] { one_line.Start({}); }), "no failure");
}

TEST(ProcessEstimator, LargeAnswersInPiecesArriveWhole) {
  auto child = Child(R"(
begin()
P = [[2.0 if i == j else 1 / (3 + i + j) for j in range(15)] for i in range(15)]
for _ in range(3):
    line = json.dumps({**belief(read()), "covariance": sum(P, [])}) + "\n"
    for i in range(0, len(line), 97):
        sys.stdout.write(line[i:i + 97]); sys.stdout.flush()
)");
  child.Start({});
  for (const models::TimeNs t_ns : {10, 20, 30}) {
    EXPECT_TRUE(child.Process(Imu(t_ns)).propagated);
    ASSERT_TRUE(child.Belief()->has_covariance);
    EXPECT_EQ(child.Belief()->covariance(14, 3), 1.0 / 20.0);
  }
}

TEST(ProcessEstimator, TalkativeStandardErrorDoesNotBlock) {
  auto child = Child(
      "begin(); read(); sys.stderr.write('x' * 300 + '\\n' + 'chatter\\n' * 200000);"
      "sys.stderr.flush(); say({})");
  child.Start({});
  EXPECT_EQ(child.Process(Imu(10)).refusal, estimator::Refusal::kNone);
  EXPECT_LT(child.child().LastErrors().size(), 100u);  // a few last lines, not 1.6 MB
}

TEST(ProcessEstimator, ChildThatDoesNotListenIsAFailureNotASignal) {
  // More sensors than a pipe's 64 KiB holds, so that the write meets a closed pipe.
  estimator::Setup setup = TwoSensors();
  setup.suite.sensors.resize(2000, setup.suite.sensors[0]);
  ProcessEstimator child(Options({"sh", "-c", "exec <&-; sleep 0.2; exit 7"}), setup);
  EXPECT_TRUE(Says(Failure([&] { child.Start({}); }), "exit code 7"));
}

TEST(ProcessEstimator, ChildThatIgnoresSigtermIsKilledWithItsOwnChildren) {
  const fs::path pid_file = fs::path(testing::TempDir()) / "process_estimator_pid";
  pid_t grandchild = 0;
  const double seconds = SecondsOf([&] {
    ProcessEstimator child(Options({"sh", "-c",
                                    "trap '' TERM; sleep 60 & echo $! > \"$0\";"
                                    "read hello; read start;"
                                    "echo '{\"ready\": true, \"error\": \"multiplicative\"}';"
                                    "while true; do sleep 60; done",
                                    pid_file.string()}),
                           TwoSensors());
    child.Start({});
    std::ifstream(pid_file) >> grandchild;
  });
  EXPECT_LT(seconds, 5.0);  // 1 s to leave, 0.5 s after SIGTERM, and a loaded machine
  ASSERT_GT(grandchild, 0);
  // Whoever inherits it reaps it a moment later; until then it shows as a zombie, state Z.
  std::string state = "R";
  for (int i = 0; i < 200 && state != "Z" && kill(grandchild, 0) == 0; ++i) {
    std::ifstream stat("/proc/" + std::to_string(grandchild) + "/stat");
    std::string skipped;
    stat >> skipped >> skipped >> state;
    usleep(5000);
  }
  EXPECT_TRUE(state == "Z" || kill(grandchild, 0) != 0) << "it still runs, in state " << state;
}

std::ptrdiff_t OpenDescriptors() {
  const fs::directory_iterator open("/proc/self/fd");
  return std::distance(fs::begin(open), fs::end(open));
}

TEST(ProcessEstimator, LeavesNoZombieAndNoDescriptor) {
  const auto before = OpenDescriptors();
  for (int i = 0; i < 5; ++i) {
    auto child = Child(i % 2 == 0 ? "begin(); read()" : "begin(); sys.exit(3)");
    child.Start({});
    if (i % 2 == 1) {
      EXPECT_NE(Failure([&] { (void)child.Process(Imu(10)); }), "no failure");
    }
    EXPECT_THROW(ProcessEstimator(Options({"no-such-program"}), TwoSensors()), ProcessStartError);
  }
  EXPECT_EQ(OpenDescriptors(), before);
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);
  EXPECT_EQ(errno, ECHILD);  // no child is left, dead or alive
}

TEST(ProcessEstimator, ChildInheritsNothingButThreePipes) {
  // One that is not marked close-on-exec, as a library may open it.
  const int ours = open("/proc/self/maps", O_RDONLY);
  auto child = Child(
      "h, s = read(), read(); fds = [f for f in os.listdir('/proc/self/fd') "
      "if os.path.exists('/proc/self/fd/' + f)];"
      "say(' '.join(sorted(fds)))");
  EXPECT_TRUE(Says(Failure([&] { child.Start({}); }), "found '0 1 2'"));
  close(ours);
}

TEST(ProcessEstimator, LeavesByItselfWhenItsInputCloses) {
  ChildProcess child({"sh", "-c", "cat >/dev/null; exit 5"}, fs::temp_directory_path());
  child.End(std::chrono::seconds(10));
  EXPECT_EQ(child.ending(), "exit code 5");
}

TEST(ProcessEstimator, RunsInItsFolder) {
  ProcessEstimator child({"mine", {"./filter.sh"}, fs::path(testing::TempDir()), 20.0, "husky"},
                         [] {
                           const fs::path script = fs::path(testing::TempDir()) / "filter.sh";
                           std::ofstream(script) << "#!/bin/sh\nread a; read b; pwd\n";
                           fs::permissions(script, fs::perms::owner_all);
                           return TwoSensors();
                         }());
  const std::string folder = fs::canonical(testing::TempDir()).string();
  EXPECT_TRUE(Says(Failure([&] { child.Start({}); }), "found '" + folder + "'"));
}

TEST(ProcessEstimator, AStopFlagEndsTheWait) {
  std::atomic<bool> stop = false;
  ProcessOptions options = Options({"sleep", "1000"}, 60.0);
  options.stop = &stop;
  ProcessEstimator child(options, TwoSensors());
  const pid_t pid = child.child().pid();
  std::thread stopper([&stop] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    stop = true;
  });
  // 0.1 s until it is raised, 0.1 s until it is seen, 0.2 s of grace: far from 60 s.
  EXPECT_LT(SecondsOf([&child] { EXPECT_THROW(child.Start({}), ProcessInterrupted); }), 2.0);
  stopper.join();
  EXPECT_EQ(kill(pid, 0), -1);
  EXPECT_EQ(errno, ESRCH);
}

std::string StartError(ProcessOptions options) {
  try {
    const ProcessEstimator child(std::move(options), TwoSensors());
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "started";
}

TEST(ProcessEstimator, WhatCannotStartIsABadInput) {
  EXPECT_TRUE(Says(StartError(Options({"no-such-program"})),
                   "estimator 'mine': can't start 'no-such-program'"));
  EXPECT_TRUE(Says(StartError(Options({"/etc/passwd"})), "Permission denied"));
  EXPECT_TRUE(Says(StartError(Options({})), "the command is empty"));
  EXPECT_TRUE(
      Says(StartError(Options({"true"}, 0.0)), "timeout_s must lie in (0, 86400], found 0"));
  EXPECT_TRUE(Says(StartError(Options({"true"}, std::nan(""))), "timeout_s"));
  ProcessOptions nowhere = Options({"true"});
  nowhere.working_folder = "/no/such/folder";
  EXPECT_TRUE(Says(StartError(nowhere), "'/no/such/folder' is not a folder"));
}

}  // namespace
}  // namespace reckon::harness
