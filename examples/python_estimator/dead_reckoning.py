#!/usr/bin/env python3
"""A Kalman filter for a wheeled robot, as an external estimator of Reckon. Standard library only.

Reckon starts this program and talks to it in lines of JSON (docs/process_estimator.md): it writes
one message to our standard input, we answer with one line on standard output, and so on until our
input closes. Anything for human eyes goes to standard error.

    hello   who the robot is: sensors with their mounting, wheels, noise; not answered
    start   where we start from;                         answer {"ready": true, "error": ...}
    imu, encoders, ...   one measurement;                answer a belief, or {} for nothing new

The filter integrates the IMU and corrects the drift with three facts about wheels: they know the
forward speed, they don't slide sideways, and they don't leave the ground. It keeps the pose of
the IMU, here the frame I: the IMU's place, with axes parallel to the body's. Names read as
Reckon's do: R_WB takes vectors from the body B to the world W; p_BI is the place of I in B.

The error that the covariance P is about is the right-invariant one, xi = Log(X_hat X^-1), because
its dynamics hardly depend on where the robot is. Its 15 entries: orientation, velocity,
position, gyroscope bias, accelerometer bias, three each.
"""

import json
import math
import statistics
import sys

# Places of the error's blocks.
TH, V, P, BG, BA = 0, 3, 6, 9, 12
N = 15


# ---- Vectors and 3 x 3 matrices are plain lists ----

def add(a, b):
    return [a[0] + b[0], a[1] + b[1], a[2] + b[2]]


def sub(a, b):
    return [a[0] - b[0], a[1] - b[1], a[2] - b[2]]


def scaled(a, s):
    return [a[0] * s, a[1] * s, a[2] * s]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def apply(M, v):
    return [r[0] * v[0] + r[1] * v[1] + r[2] * v[2] for r in M]


def transposed(M):
    return [list(column) for column in zip(*M)]


def product(A, B):
    columns = list(zip(*B))
    return [[r[0] * c[0] + r[1] * c[1] + r[2] * c[2] for c in columns] for r in A]


def skew(a):
    """[a]x: the matrix whose product with b is the cross product a x b."""
    return [[0.0, -a[2], a[1]], [a[2], 0.0, -a[0]], [-a[1], a[0], 0.0]]


def gamma(phi, m):
    """Gamma_m(phi) = sum over n of [phi]x^n / (n + m)!, for m = 0, 1, 2.

    Gamma_0 is the rotation by phi; Gamma_1 and Gamma_2 are its first and second integrals over a
    step in which the turn rate is constant. [phi]x^3 = -|phi|^2 [phi]x folds the series into
    c0 I + c1 [phi]x + c2 [phi]x^2.
    """
    s = phi[0] * phi[0] + phi[1] * phi[1] + phi[2] * phi[2]

    def series(first):
        # 1/first! - s/(first + 2)! + s^2/(first + 4)! - ...
        term = 1.0 / math.factorial(first)
        total, k = 0.0, first
        while abs(term) > 1e-18:
            total += term
            term *= -s / ((k + 1) * (k + 2))
            k += 2
        return total

    c0, c1, c2 = 1.0 / math.factorial(m), series(m + 1), series(m + 2)
    x, y, z = phi
    return [[c0 + c2 * (x * x - s), c2 * x * y - c1 * z, c2 * x * z + c1 * y],
            [c2 * x * y + c1 * z, c0 + c2 * (y * y - s), c2 * y * z - c1 * x],
            [c2 * x * z - c1 * y, c2 * y * z + c1 * x, c0 + c2 * (z * z - s)]]


def rotation_from_quaternion(q):
    w, x, y, z = q
    return [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]


def quaternion_from_rotation(R):
    """[w, x, y, z], from whichever component is largest: no division by a small number."""
    t = R[0][0] + R[1][1] + R[2][2]
    if t > 0.0:
        q = [1.0 + t, R[2][1] - R[1][2], R[0][2] - R[2][0], R[1][0] - R[0][1]]
    else:
        i = max(range(3), key=lambda n: R[n][n])
        j, k = (i + 1) % 3, (i + 2) % 3
        q = [R[k][j] - R[j][k], 0.0, 0.0, 0.0]
        q[1 + i] = 1.0 + R[i][i] - R[j][j] - R[k][k]
        q[1 + j] = R[i][j] + R[j][i]
        q[1 + k] = R[i][k] + R[k][i]
    norm = math.sqrt(sum(c * c for c in q))
    return [c / norm for c in q]


def carried(F, cov):
    """F cov F' for F = I + (a few entries): F is {row: [(column, value), ...]} without the I."""
    half = [list(row) for row in cov]
    for i, entries in F.items():
        for j, value in entries:
            source, target = cov[j], half[i]
            for k in range(N):
                target[k] += value * source[k]
    out = [list(row) for row in half]
    for i, entries in F.items():
        for j, value in entries:
            for k in range(N):
                out[k][i] += value * half[k][j]
    return out


def put(F, row, column, block):
    for i in range(3):
        F.setdefault(row + i, []).extend(
            (column + j, block[i][j]) for j in range(3) if block[i][j] != 0.0)


class Filter:
    """Everything the filter knows; see the module's docstring for the frames."""

    def __init__(self, hello):
        imu = next(s for s in hello["sensors"] if s["kind"] == "imu")
        self.imu = imu["id"]
        self.R_BS = rotation_from_quaternion(imu["q_BS"])
        self.p_BI = imu["p_BS_m"]
        self.gravity = [0.0, 0.0, -hello["gravity_m_s2"]]

        noise = hello["noise"]
        self.gyro_noise = noise["gyro_noise_density_rad_per_s_sqrt_hz"]
        self.accel_noise = noise["accel_noise_density_m_per_s2_sqrt_hz"]
        # A bias that is not to be estimated starts with zero covariance and must not gain any.
        self.gyro_walk = (noise["gyro_bias_walk_rad_per_s2_sqrt_hz"]
                          if hello["estimate_gyro_bias"] else 0.0)
        self.accel_walk = (noise["accel_bias_walk_m_per_s3_sqrt_hz"]
                           if hello["estimate_accel_bias"] else 0.0)
        self.wheel_sigma = [noise["wheel_forward_m_per_s"], noise["wheel_lateral_m_per_s"],
                            noise["wheel_vertical_m_per_s"]]

        # A correction whose normalised innovation squared is beyond this chi-square quantile (one
        # degree of freedom: the square of a normal one) is not believed: a wheel that spins.
        probability = hello["gate"]["probability"]
        self.gate = math.inf
        if hello["gate"]["action"] in ("reject", "inflate") and probability < 1.0:
            self.gate = statistics.NormalDist().inv_cdf(0.5 + 0.5 * probability) ** 2

        self.wheels = hello["wheels"]
        self.encoders = None
        if self.wheels:
            self.encoders = next(s["id"] for s in hello["sensors"]
                                 if s["name"] == self.wheels["encoders"])
            self.R_SB = transposed(rotation_from_quaternion(self.wheels["q_BS"]))
            self.p_IS = sub(self.wheels["p_BS_m"], self.p_BI)   # I's axes are B's

    def start(self, prior):
        self.t_ns = prior["t_ns"]
        self.R = rotation_from_quaternion(prior["q_WB"])
        # From the body to the IMU: p_WI = p_WB + R p_BI, v_WI = v_WB + R (w x p_BI).
        self.p = add(prior["p_WB"], apply(self.R, self.p_BI))
        self.v = add(prior["v_WB"], apply(self.R, cross(prior["w_WB_B"], self.p_BI)))
        self.gyro_bias = prior["gyro_bias_rad_s"]
        self.accel_bias = prior["accel_bias_m_s2"]
        self.turn_rate = prior["w_WB_B"]
        # With a given turn rate, the right-invariant error of I is that of B.
        cov = prior["covariance"]
        self.cov = [cov[N * i:N * (i + 1)] for i in range(N)]
        self.waiting = []       # encoder messages that are newer than the IMU
        self.corrections = []   # done since the last answer

    # ---- one message in, one answer out ----

    def answer(self, message):
        if message["message"] == "imu" and message["sensor"] == self.imu:
            return self.take_imu(message)
        if message["message"] == "encoders" and message["sensor"] == self.encoders:
            return self.take_encoders(message)
        return {"refusal": "unused"}

    def take_imu(self, message):
        if None in message["gyro_rad_s"] or None in message["accel_m_s2"]:
            return {"refusal": "not_finite"}   # the next good sample will cover this step too
        # Durations come from the integer stamps. Where samples are missing, the new one is held
        # over the whole gap.
        dt = (message["valid_ns"] - self.t_ns) * 1e-9
        if dt <= 0.0:
            return {"refusal": "backwards"}
        self.turn_rate = sub(apply(self.R_BS, message["gyro_rad_s"]), self.gyro_bias)
        force = sub(apply(self.R_BS, message["accel_m_s2"]), self.accel_bias)
        self.propagate_covariance(dt)
        self.propagate_state(self.turn_rate, force, dt)
        self.t_ns = message["valid_ns"]

        ready = [m for m in self.waiting if m["valid_ns"] <= self.t_ns]
        self.waiting = [m for m in self.waiting if m["valid_ns"] > self.t_ns]
        for encoders in ready:
            self.correct(encoders)
        return self.belief()

    def take_encoders(self, message):
        if None in message["rate_rad_s"]:
            return {"refusal": "not_finite"}
        if message["valid_ns"] > self.t_ns:
            self.waiting.append(message)   # until the IMU has come that far
            return {}
        # A message that is a little old is used as if it were new: at 0.5 m/s^2, 20 ms of delay
        # are 0.01 m/s.
        self.correct(message)
        return self.belief()

    # ---- prediction ----

    def propagate_state(self, w, a, dt):
        """The exact solution for a turn rate w and a specific force a that hold for dt."""
        phi = scaled(w, dt)
        R, g = self.R, self.gravity
        dv = add(apply(R, scaled(apply(gamma(phi, 1), a), dt)), scaled(g, dt))
        dp = add(apply(R, scaled(apply(gamma(phi, 2), a), dt * dt)), scaled(g, 0.5 * dt * dt))
        self.p = add(add(self.p, scaled(self.v, dt)), dp)
        self.v = add(self.v, dv)
        self.R = product(R, gamma(phi, 0))

    def propagate_covariance(self, dt):
        """P <- F P F' + Q, with F = I + A dt (the steps are short) and the error dynamics A:

            theta' = -R bg        v' = [g]x theta - [v]x R bg - R ba        p' = v - [p]x R bg
        """
        R = self.R
        v_cross, p_cross = skew(self.v), skew(self.p)
        F = {}
        put(F, TH, BG, [scaled(row, -dt) for row in R])
        put(F, V, TH, [scaled(row, dt) for row in skew(self.gravity)])
        put(F, V, BG, [scaled(row, -dt) for row in product(v_cross, R)])
        put(F, V, BA, [scaled(row, -dt) for row in R])
        put(F, P, V, [[dt, 0.0, 0.0], [0.0, dt, 0.0], [0.0, 0.0, dt]])
        put(F, P, BG, [scaled(row, -dt) for row in product(p_cross, R)])
        cov = carried(F, self.cov)

        # White noise. The gyroscope's enters all three blocks by G = [I; [v]x; [p]x]; that R turns
        # it first does not matter, since it is the same in all directions.
        q = self.gyro_noise ** 2 * dt
        G = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] + v_cross + p_cross
        for i in range(9):
            a, row = G[i], cov[i]
            for j in range(9):
                b = G[j]
                row[j] += q * (a[0] * b[0] + a[1] * b[1] + a[2] * b[2])
        for block, density in ((V, self.accel_noise), (BG, self.gyro_walk), (BA, self.accel_walk)):
            for i in range(block, block + 3):
                cov[i][i] += density ** 2 * dt
        self.cov = cov

    # ---- correction ----

    def correct(self, encoders):
        """Forward, sideways and upward speed at the wheels' frame S, one after the other.

        Each is a measurement y_i = e_i . R_SB (R' v + w x p_IS) of a single number, so no matrix
        has to be inverted.
        """
        rates = encoders["rate_rad_s"]
        chosen = self.wheels["left"] + self.wheels["right"]
        forward = self.wheels["rolling_radius_m"] * sum(rates[i] for i in chosen) / len(chosen)
        for axis, y in enumerate((forward, 0.0, 0.0)):
            e_B = self.R_SB[axis]   # the measured direction, in the body's axes
            v_B = add(apply(transposed(self.R), self.v), cross(self.turn_rate, self.p_IS))
            innovation = y - sum(e * v for e, v in zip(e_B, v_B))
            # The row h of z = -h xi: R e_B at the velocity and [p_IS]x at the gyroscope's bias,
            # which moves S through the lever arm.
            e_W = apply(self.R, e_B)
            h = [0.0] * N
            h[V:V + 3] = e_W
            h[BG:BG + 3] = apply(transposed(skew(self.p_IS)), e_B)
            result = self.update(h, innovation, self.wheel_sigma[axis] ** 2)
            self.corrections.append({"sensor": self.encoders, "t_ns": self.t_ns, **result})

    def update(self, h, innovation, variance):
        """A scalar Kalman update: gain k = P h / s, state <- exp(k z) state, P <- P - k s k'."""
        used = [j for j in range(N) if h[j] != 0.0]
        Ph = [sum(row[j] * h[j] for j in used) for row in self.cov]
        s = sum(h[j] * Ph[j] for j in used) + variance
        accepted = innovation * innovation <= self.gate * s
        if accepted:
            for i in range(N):
                row, k = self.cov[i], Ph[i] / s
                for j in range(N):
                    row[j] -= k * Ph[j]
            self.move([p * innovation / s for p in Ph])
        return {"innovation": [innovation], "covariance": [s],
                "decision": "accepted" if accepted else "rejected"}

    def move(self, xi):
        """X <- exp(xi) X for the pose and velocity; the biases just add."""
        theta = xi[TH:TH + 3]
        turn, jacobian = gamma(theta, 0), gamma(theta, 1)
        self.R = product(turn, self.R)
        self.v = add(apply(turn, self.v), apply(jacobian, xi[V:V + 3]))
        self.p = add(apply(turn, self.p), apply(jacobian, xi[P:P + 3]))
        self.gyro_bias = add(self.gyro_bias, xi[BG:BG + 3])
        self.accel_bias = add(self.accel_bias, xi[BA:BA + 3])
        self.turn_rate = sub(self.turn_rate, xi[BG:BG + 3])

    # ---- what we believe of the body ----

    def belief(self):
        p_IB = scaled(self.p_BI, -1.0)
        # The errors of orientation and position are the same for I and B. That of velocity is not:
        # an error of the gyroscope's bias acts through the lever arm.
        F = {}
        put(F, V, BG, product(self.R, skew(p_IB)))
        cov = carried(F, self.cov)
        corrections, self.corrections = self.corrections, []
        return {
            "t_ns": self.t_ns,
            "q_WB": quaternion_from_rotation(self.R),
            "p_WB": add(self.p, apply(self.R, p_IB)),
            "v_WB": add(self.v, apply(self.R, cross(self.turn_rate, p_IB))),
            "gyro_bias_rad_s": self.gyro_bias,
            "accel_bias_m_s2": self.accel_bias,
            # The upper triangle, row by row: 120 numbers instead of 225.
            "covariance": [cov[i][j] for i in range(N) for j in range(i, N)],
            # What the corrections found, for the scores of consistency. Optional.
            "corrections": corrections[:8],
        }


def main():
    estimator = None
    for line in sys.stdin:
        message = json.loads(line)
        if message["message"] == "hello":
            estimator = Filter(message)
            continue   # the one message without an answer
        if message["message"] == "start":
            estimator.start(message)
            answer = {"ready": True, "error": "right_invariant"}
        else:
            answer = estimator.answer(message)
        # allow_nan=False: better a clear error here than a line that is not JSON. The flush
        # matters: without it the answer would stay in a buffer and Reckon would wait in vain.
        print(json.dumps(answer, allow_nan=False), flush=True)


if __name__ == "__main__":
    main()
