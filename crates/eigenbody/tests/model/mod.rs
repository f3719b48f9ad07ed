mod build;
mod configuration;
mod coupling;
mod description;
mod finding;
mod topology;
