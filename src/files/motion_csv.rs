//! motion_csv
