"""Reads a recording as a user would: recording_check.py SAMPLE_RECORDING"""

import subprocess
import sys
import tempfile

import h5py
import numpy as np


def main():
    with tempfile.TemporaryDirectory() as folder:
        path = folder + "/run.h5"
        subprocess.run([sys.argv[1], path], check=True)
        with h5py.File(path) as run:
            check(run)


def check(run):
    truth = run["truth"][:]
    assert truth.shape == (1500,)
    assert (truth["t_ns"] == np.arange(1500)).all()
    assert (truth["p_WB_y_m"] == 2.0 * np.arange(1500)).all()

    units = dict(zip(truth.dtype.names, run["truth"].attrs["units"]))
    frames = dict(zip(truth.dtype.names, run["truth"].attrs["frames"]))
    assert units["v_WB_x_m_s"] == "m/s" and frames["w_WB_B_x_rad_s"] == "B"
    assert run.attrs["format"] == "reckon recording 1"
    assert "Log(Rh R^T)" in run.attrs["error_right_invariant"]
    assert list(run.attrs["sensors"]) == ["imu", "encoders", "dvl"]

    riekf = run["estimates/riekf"]
    covariance = riekf["covariance"]
    assert covariance.shape == (1500, 120)
    diagonal = covariance.attrs["row"] == covariance.attrs["column"]
    assert (covariance[:][:, diagonal] == np.arange(1.0, 16.0)).all()
    assert list(covariance.attrs["error_names"])[6] == "position_x"
    names = riekf["state"].attrs["error_form_names"]
    assert names[riekf["state"]["error_form"][0]] == "multiplicative"
    assert list(riekf["corrections"].attrs["decision_names"])[3] == "rejected"

    imu = run["measurements/imu"]
    assert imu.attrs["kind"] == "imu"
    assert (imu["accel_z_m_s2"] == 9.81).all()
    rotation = imu.attrs["R_BS"].reshape(3, 3)
    assert abs(rotation[2, 1] - np.sin(0.3)) < 1e-15  # a turn by +0.3 rad about x
    print("h5py reads the recording")


if __name__ == "__main__":
    main()
