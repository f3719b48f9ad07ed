mod build;
mod configuration;
mod coupling;
mod derived;
mod description;
mod finding;
mod topology;
