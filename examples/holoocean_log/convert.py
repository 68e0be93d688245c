#!/usr/bin/env python3
"""Turns the log of a simulated underwater vehicle (HoloOcean, as in frostlab's `inekf`) into a log
folder that `reckon replay` reads.

    examples/holoocean_log/convert.py LOG.txt FOLDER

Rows of the log, one sensor each: IMU t wx wy wz ax ay az; VEL t vx vy vz (in the DVL's frame);
DEPTH t z (upwards); GT t px py pz qx qy qz qw vx vy vz (v in the world).
"""

import pathlib
import sys

HEADERS = {
    "imu": "t_s,gyro_x_rad_s,gyro_y_rad_s,gyro_z_rad_s,accel_x_m_s2,accel_y_m_s2,accel_z_m_s2",
    "dvl": "t_s,v_x_m_s,v_y_m_s,v_z_m_s",
    "depth": "t_s,depth_m",
    "truth": "t_s,p_x_m,p_y_m,p_z_m,q_x,q_y,q_z,q_w,v_x_m_s,v_y_m_s,v_z_m_s",
}
FILES = {"IMU": "imu", "VEL": "dvl", "DEPTH": "depth", "GT": "truth"}

DESCRIPTION = """\
schema: 1
description: An underwater vehicle simulated in HoloOcean, 18.4 s with IMU, DVL and depth
gravity_m_s2: 9.8
sensors:
  imu: {type: imu, file: imu.csv, rate_hz: 200}
  dvl:
    type: body_velocity
    file: dvl.csv
    rate_hz: 200
    position_m: [-0.17137, 0.00922, -0.33989]
    rotation_matrix: [0.000, -0.995, 0.105, 0.999, 0.005, 0.052, -0.052, 0.104, 0.993]
    noise_m_per_s: [0.02626, 0.02626, 0.02626]
  depth: {type: depth, file: depth.csv, rate_hz: 200}
nominal:
  # Estimated on the first five seconds: white noise from differences of neighbours, walks from Allan
  # deviations over 0.1 to 0.4 s.
  noise:
    gyro_noise_density_rad_per_s_sqrt_hz: 9.9e-5
    accel_noise_density_m_per_s2_sqrt_hz: 5.2e-5
    gyro_bias_walk_rad_per_s2_sqrt_hz: 1.2e-2
    accel_bias_walk_m_per_s3_sqrt_hz: 1.57e-2
    depth_m: 0.25
truth: truth.csv
"""


def convert(log, folder):
    folder.mkdir(parents=True, exist_ok=True)
    rows = {name: [header] for name, header in HEADERS.items()}
    for number, line in enumerate(log.read_text().splitlines(), start=1):
        kind, *values = line.split()
        if kind not in FILES:
            raise SystemExit(f"{log}:{number}: no such row: {kind}")
        if kind == "DEPTH":  # the log's is a height
            values[1] = str(-float(values[1]))
        rows[FILES[kind]].append(",".join(values))
    for name, lines in rows.items():
        (folder / f"{name}.csv").write_text("\n".join(lines) + "\n")
    (folder / "log.yaml").write_text(DESCRIPTION)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        raise SystemExit(__doc__)
    convert(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))
