mod claims;
mod geometry;
mod onion;
mod puma560;
mod table;
