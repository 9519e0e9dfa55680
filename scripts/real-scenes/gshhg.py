#!/usr/bin/python3
"""gshhg.py NETCDF: the coastlines, or rivers or borders, of GSHHG as GeoJSON, for the Python of Debian with python3-netcdf4.

The file keeps lines bin by bin, as 16-bit steps from the south-west corner of each bin. Coordinates are whole numbers of
these steps, 65535 a bin, from longitude 0 and latitude -90: nothing is rounded. Where a file has two coasts of
Antarctica, the front of the ice is taken, not the ground below.
"""
import json
import sys

import netCDF4

STEPS = 65535


def lines(path):
    with netCDF4.Dataset(path) as file:
        file.set_auto_mask(False)
        across = int(file["N_bins_in_360_longitude_range"][0])
        upwards = int(file["N_bins_in_180_degree_latitude_range"][0])
        first_segment = file["Id_of_first_segment_in_a_bin"][:].tolist()
        segments = file["N_segments_in_a_bin"][:].tolist()
        info = file["Embedded_npts_levels_exit_entry_for_a_segment"][:].tolist()
        first_point = file["Id_of_first_point_in_a_segment"][:].tolist()
        coast = "Embedded_ANT_flag" in file.variables
        ground = file["Embedded_ANT_flag"][:].tolist() if coast else [0] * len(info)
        x = [v & 0xFFFF for v in file["Relative_longitude_from_SW_corner_of_bin"][:].tolist()]
        y = [v & 0xFFFF for v in file["Relative_latitude_from_SW_corner_of_bin"][:].tolist()]
    for cell, (first, count) in enumerate(zip(first_segment, segments)):
        west, south = cell % across * STEPS, (upwards - 1 - cell // across) * STEPS
        for s in range(first, first + count):
            if ground[s] == 2:
                continue
            points = range(first_point[s], first_point[s] + (info[s] >> 9))
            line = [(west + x[p], south + y[p]) for p in points]
            yield [p for i, p in enumerate(line) if i == 0 or p != line[i - 1]]


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    features = [
        {"type": "Feature", "properties": {}, "geometry": {"type": "LineString", "coordinates": line}}
        for line in lines(sys.argv[1])
        if len(line) > 1
    ]
    json.dump({"type": "FeatureCollection", "features": features}, sys.stdout)


main()
